#include "experiments/calibration_cache.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/atomic_file.h"
#include "core/calibration_io.h"
#include "core/input_error.h"
#include "experiments/versions.h"

namespace fenestra {
namespace {

// FNV-1a, 64 bit.
uint64_t HashOf(const std::string& text) {
  uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return hash;
}

// The text as YAML comments, after the calibration that it belongs to.
std::string AsComments(const std::string& text) {
  std::istringstream lines(text);
  std::string comments;
  for (std::string line; std::getline(lines, line);) comments += "# " + line + "\n";
  return comments;
}

// What a file holds of a calibration: its sum shows damage.
std::string Sealed(const std::string& yaml, const std::string& comments) {
  return yaml + fmt::format("# sum {:016x}\n", HashOf(yaml)) + comments;
}

std::optional<StereoCalibration> Read(const std::filesystem::path& file,
                                      const std::string& comments) {
  // A folder can be opened as a file; reading it is what fails.
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const size_t end = text.find("# sum ");
  if (end == std::string::npos || text != Sealed(text.substr(0, end), comments)) {
    return std::nullopt;
  }
  try {
    return ReadStereoCalibration(file);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

CalibrationCache CalibrationCache::OfUser() {
  if (BuildId().empty()) return {};
  if (const char* own = std::getenv("FENESTRA_CACHE")) return CalibrationCache(own);
  if (const char* xdg = std::getenv("XDG_CACHE_HOME")) {
    return CalibrationCache(std::filesystem::path(xdg) / "fenestra");
  }
  if (const char* home = std::getenv("HOME")) {
    return CalibrationCache(std::filesystem::path(home) / ".cache" / "fenestra");
  }
  return {};
}

StereoCalibration CalibrationCache::Get(const std::string& content,
                                        const std::function<StereoCalibration()>& compute) const {
  if (!folder_) return compute();
  const std::string comments = AsComments("build " + BuildId() + "\n" + content);
  const std::filesystem::path file =
      *folder_ / fmt::format("calibration-{:016x}.yaml", HashOf(comments));
  if (const auto known = Read(file, comments)) return *known;
  const StereoCalibration computed = compute();
  try {
    WriteFileAtomically(file, Sealed(ToOpenCvYaml(computed), comments));
  } catch (const InputError&) {
    // Computed again next time.
  }
  return computed;
}

}  // namespace fenestra
