#include "renderers/tracing/render_types.h"

#include <fmt/format.h>

#include "core/io/faults.h"

namespace fenestra {

void Validate(const RenderOptions& options) {
  Faults faults("render");
  const auto check = [&faults](const char* name, int samples) {
    faults.Require(samples == 1 || samples == 4 || samples == 16 || samples == 64 || samples == 256,
                   fmt::format("{} must be 1, 4, 16, 64 or 256, not {}", name, samples));
  };
  check("samples_per_pixel", options.samples_per_pixel);
  check("edge_samples_per_pixel", options.edge_samples_per_pixel);
  faults.Require(options.edge_samples_per_pixel >= options.samples_per_pixel,
                 fmt::format("edge_samples_per_pixel ({}) must not be less than "
                             "samples_per_pixel ({})",
                             options.edge_samples_per_pixel, options.samples_per_pixel));
  faults.ThrowIfAny();
}

}  // namespace fenestra
