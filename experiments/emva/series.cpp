#include "experiments/emva/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <sstream>

#include "core/io/faults.h"
#include "core/io/input_file.h"

namespace fenestra::emva {
namespace {

constexpr double kNanosecond = 1e-9;

// A number with a decimal point, or with the comma that some programs write.
std::optional<double> NumberIn(std::string word) {
  std::replace(word.begin(), word.end(), ',', '.');
  std::istringstream stream(word);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (!(stream >> value) || !(stream >> std::ws).eof() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

// Reads the lines of one descriptor and collects what is wrong with them.
class DescriptorReader {
 public:
  explicit DescriptorReader(const std::filesystem::path& file) : faults_(file.string()) {
    std::ifstream stream = OpenInput(file);
    for (std::string line; std::getline(stream, line);) {
      ++line_;
      Read(line);
    }
    Check();
    faults_.ThrowIfAny();
  }

  Series TakeSeries() { return std::move(series_); }

 private:
  void Read(const std::string& line) {
    std::istringstream stream(line);
    std::string key;
    if (!(stream >> key) || key.starts_with('#')) return;
    if (key == "v") return;  // The format's version.
    if (key == "i") return ReadImageName(stream);
    std::vector<double> values;
    for (std::string word; stream >> word;) {
      const auto value = NumberIn(word);
      if (!value || *value < 0.0) {
        if (key == "b" || key == "d") in_faulty_set_ = true;
        return Fault(fmt::format("'{}' is not a positive number", word));
      }
      values.push_back(*value);
    }
    if (key == "n" && values.size() == 3) return ReadFormat(values);
    if (key == "b" && values.size() == 2) return StartSet(values[0], values[1]);
    if (key == "d" && values.size() == 1) return StartSet(values[0], 0.0);
    // Most likely an exposure: the files that follow are its own, not the one's before.
    in_faulty_set_ = true;
    Fault("is none of: n bits width height; b exposure_ns photons; d exposure_ns; i file");
  }

  void ReadFormat(const std::vector<double>& values) {
    if (!series_.size.empty()) return Fault("repeats the line 'n bits width height'");
    const auto [bits, width, height] = std::tie(values[0], values[1], values[2]);
    if (!(bits >= 1.0 && bits <= 16.0 && width >= 2.0 && width <= 16384.0 && height >= 2.0 &&
          height <= 16384.0)) {
      return Fault("bits must be 1 to 16, width and height 2 to 16384");
    }
    series_.bits = static_cast<int>(bits);
    series_.size = {static_cast<int>(width), static_cast<int>(height)};
  }

  void StartSet(double exposure_ns, double photons) {
    series_.sets.push_back(
        {.exposure_s = exposure_ns * kNanosecond, .photons = photons, .files = {}});
    set_lines_.push_back(line_);
    in_faulty_set_ = false;
  }

  void ReadImageName(std::istringstream& stream) {
    std::string file;
    std::getline(stream >> std::ws, file);
    while (!file.empty() && (file.back() == '\r' || file.back() == ' ')) file.pop_back();
    if (in_faulty_set_) return;  // Its fault has been noted.
    if (series_.sets.empty()) return Fault("names a file before any exposure");
    std::replace(file.begin(), file.end(), '\\', '/');
    series_.sets.back().files.push_back(file);
  }

  // Notes what the lines together lack.
  void Check() {
    if (series_.size.empty()) Fault("has no line 'n bits width height'");
    std::map<std::pair<bool, double>, int> seen;
    for (size_t i = 0; i < series_.sets.size(); ++i) {
      const ImageSet& set = series_.sets[i];
      line_ = set_lines_[i];
      if (set.files.size() < 2) Fault("needs two files: temporal noise is their difference");
      // The fraction tells bright pairs of one exposure apart.
      const auto key = std::make_pair(set.is_spatial(), set.exposure_s + 1e6 * set.photons);
      if (seen[key]++ > 0) Fault("repeats an exposure");
    }
  }

  void Fault(std::string message) {
    faults_.AddFault({.line = line_, .message = std::move(message)});
  }

  Faults faults_;
  int line_ = 0;
  Series series_;
  std::vector<int> set_lines_;
  bool in_faulty_set_ = false;  ///< Since the last line that should have begun one.
};

}  // namespace

std::string ToDescriptor(const Series& series) {
  std::string text =
      fmt::format("v 4.0\nn {} {} {}\n", series.bits, series.size.width, series.size.height);
  for (const ImageSet& set : series.sets) {
    const double exposure_ns = set.exposure_s / kNanosecond;
    text += set.is_dark() ? fmt::format("d {:.3f}\n", exposure_ns)
                          : fmt::format("b {:.3f} {:.6f}\n", exposure_ns, set.photons);
    for (std::string file : set.files) {
      std::replace(file.begin(), file.end(), '/', '\\');
      text += "i " + file + "\n";
    }
  }
  return text;
}

Series ReadDescriptor(const std::filesystem::path& file) {
  return DescriptorReader(file).TakeSeries();
}

ImageReader FilesBeside(const std::filesystem::path& descriptor, const Series& series) {
  const std::filesystem::path folder = descriptor.parent_path();
  return [folder, bits = series.bits, size = series.size](const ImageSet& set, size_t index) {
    const std::filesystem::path file = folder / set.files[index];
    OpenInput(file);  // OpenCV tells no reason.
    const cv::Mat image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
    if (image.empty()) throw InputError(file.string(), "is not a readable image");
    if (image.channels() != 1 || (image.depth() != CV_8U && image.depth() != CV_16U)) {
      throw InputError(file.string(), "must have one channel of 8 or 16 bits");
    }
    if (image.size() != size) {
      throw InputError(file.string(), fmt::format("has {} x {} px, the descriptor says {} x {}",
                                                  image.cols, image.rows, size.width, size.height));
    }
    cv::Mat1w dn;
    image.convertTo(dn, CV_16U);
    double largest = 0.0;
    cv::minMaxLoc(dn, nullptr, &largest);
    if (largest >= std::ldexp(1.0, bits)) {
      throw InputError(file.string(),
                       fmt::format("has values up to {:.0f}, too many for {} bits", largest, bits));
    }
    return dn;
  };
}

}  // namespace fenestra::emva
