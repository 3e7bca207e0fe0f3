#pragma once

#include "scenes/facade/facade_options.h"

namespace fenestra {

/// Throws InputError, with all faults, for sizes that do not fit into each other and for numbers
/// out of their domain.
void Validate(const FacadeOptions& options);

}  // namespace fenestra
