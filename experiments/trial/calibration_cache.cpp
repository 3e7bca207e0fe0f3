#include "experiments/trial/calibration_cache.h"

#include <fmt/format.h>

#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "core/geometry/calibration.h"
#include "core/io/input_file.h"
#include "core/io/sha256.h"
#include "core/io/temporary_files.h"
#include "core/system/check.h"
#include "core/system/program.h"

namespace fenestra {
namespace {

constexpr char kSum[] = "# sha256 ";

// What a file holds of a calibration: its sum shows damage.
std::string Sealed(const std::string& content) {
  return content + kSum + Sha256(content) + "\n";
}

constexpr char kCovariance[] = "# covariance ";

std::string ToText(const CalibrationWithCovariance& stated) {
  const double* numbers = stated.covariance.data();
  return fmt::format("{}{}{}\n", ToOpenCvYaml(stated.calibration), kCovariance,
                     fmt::join(numbers, numbers + stated.covariance.size(), " "));
}

PairMatrix CovarianceIn(const std::string& text) {
  std::istringstream numbers(text.substr(text.find(kCovariance) + sizeof kCovariance - 1));
  PairMatrix covariance;
  std::string number;
  for (double& element : covariance.reshaped()) {
    numbers >> number;
    element = std::strtod(number.c_str(), nullptr);
  }
  return covariance;
}

constexpr uintmax_t kLargestFile = 1u << 20;

std::optional<CalibrationWithCovariance> Read(const std::filesystem::path& file) {
  try {
    const std::string text = ReadWholeFile(file, kLargestFile);
    const size_t end = text.find(kSum);
    if (end == std::string::npos || text != Sealed(text.substr(0, end))) return std::nullopt;
    return CalibrationWithCovariance{ReadStereoCalibration(file), CovarianceIn(text)};
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

// A variable that is empty or not an absolute path is passed over, as the XDG base directory
// specification has it: the cache would stand wherever the program happens to be started.
std::optional<std::filesystem::path> FolderIn(const char* variable) {
  const char* value = std::getenv(variable);
  if (value == nullptr || !std::filesystem::path(value).is_absolute()) return std::nullopt;
  return value;
}

}  // namespace

CalibrationCache CalibrationCache::OfUser() {
  if (BuildId().empty()) return {};
  if (const auto own = FolderIn("FENESTRA_CACHE")) return CalibrationCache(*own);
  if (const auto xdg = FolderIn("XDG_CACHE_HOME")) return CalibrationCache(*xdg / "fenestra");
  if (const auto home = FolderIn("HOME")) return CalibrationCache(*home / ".cache" / "fenestra");
  return {};
}

CalibrationWithCovariance CalibrationCache::Get(
    const std::string& content, const std::function<CalibrationWithCovariance()>& compute) const {
  if (!folder_) return compute();
  const std::string key = Sha256("build " + BuildId() + "\n" + content);
  const std::filesystem::path file = *folder_ / ("calibration-" + key + ".yaml");
  if (const auto known = Read(file)) return *known;
  CalibrationWithCovariance computed = compute();
  try {
    WriteFileAtomically(file, Sealed(ToText(computed)));
  } catch (const std::runtime_error&) {
    // Computed again next time.
  }
  return computed;
}

}  // namespace fenestra
