#include "renderers/render_types.h"

#include <fmt/format.h>

#include <vector>

#include "core/input_error.h"

namespace fenestra {

void Validate(const RenderOptions& options) {
  std::vector<InputFault> faults;
  const auto check = [&faults](const char* name, int samples) {
    if (samples == 1 || samples == 4 || samples == 16 || samples == 64 || samples == 256) return;
    faults.push_back(
        {"render", 0, 0, fmt::format("{} must be 1, 4, 16, 64 or 256, not {}", name, samples)});
  };
  check("samples_per_pixel", options.samples_per_pixel);
  check("edge_samples_per_pixel", options.edge_samples_per_pixel);
  if (options.edge_samples_per_pixel < options.samples_per_pixel) {
    faults.push_back({"render", 0, 0,
                      fmt::format("edge_samples_per_pixel ({}) must not be less than "
                                  "samples_per_pixel ({})",
                                  options.edge_samples_per_pixel, options.samples_per_pixel)});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
}

}  // namespace fenestra
