#include "core/io/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <string_view>

#include "core/io/input_error.h"
#include "core/io/input_file.h"
#include "core/io/temporary_files.h"

namespace fenestra {
namespace {

constexpr int kLargestSide = 16384;
constexpr const char* kNotAnImage = "not a readable image (PNG, TIFF, JPEG, PGM)";
constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1a\n";

uint32_t BigEndian(const char* bytes) {
  uint32_t number = 0;
  for (int i = 0; i < 4; ++i) number = (number << 8) | static_cast<unsigned char>(bytes[i]);
  return number;
}

// The first bytes of a file: its format and, of a PNG, its size.
std::string StartOf(const std::filesystem::path& file) {
  constexpr size_t kBytes = 24;
  std::string start(kBytes, '\0');
  std::ifstream stream = OpenInput(file);
  stream.read(start.data(), kBytes);
  start.resize(static_cast<size_t>(stream.gcount()));
  return start;
}

// A PNG header states its size before anything is decompressed: a small file may claim to be a
// huge image.
void RefuseHugePng(const std::filesystem::path& file, const std::string& start) {
  if (start.size() < 24 || !start.starts_with(kPngSignature)) return;
  const uint32_t width = BigEndian(&start[16]);
  const uint32_t height = BigEndian(&start[20]);
  if (width > kLargestSide || height > kLargestSide) {
    throw InputError(file, fmt::format("{} x {} pixels; at most {} a side are read", width, height,
                                       kLargestSide));
  }
}

// OpenCV reads some twenty formats, some of them through libraries that were never meant for files
// from outside; only these are let through to it.
bool IsKnownFormat(const std::string& start) {
  constexpr std::array<std::string_view, 8> kStarts = {kPngSignature,
                                                       "\xff\xd8\xff",
                                                       std::string_view("II*\0", 4),
                                                       std::string_view("MM\0*", 4),
                                                       "P2",
                                                       "P3",
                                                       "P5",
                                                       "P6"};
  return std::any_of(kStarts.begin(), kStarts.end(),
                     [start](std::string_view known) { return start.starts_with(known); });
}

cv::Mat Read(const std::filesystem::path& file) {
  const std::string start = StartOf(file);
  RefuseHugePng(file, start);
  if (!IsKnownFormat(start)) throw InputError(file, kNotAnImage);
  cv::Mat image;
  try {
    image = cv::imread(file.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw InputError(file, kNotAnImage);
  if (image.cols > kLargestSide || image.rows > kLargestSide) {
    throw InputError(file, fmt::format("{} x {} pixels; at most {} a side are read", image.cols,
                                       image.rows, kLargestSide));
  }
  return image;
}

[[noreturn]] void Refuse(const std::filesystem::path& file, const cv::Mat& image,
                         const std::string& wanted) {
  throw InputError(file, fmt::format("must be {}, not {} channel(s) of {} bits", wanted,
                                     image.channels(), 8 * image.elemSize1()));
}

}  // namespace

cv::Mat1b ReadGrayImage(const std::filesystem::path& file) {
  cv::Mat image = Read(file);
  if (image.type() != CV_8UC1) Refuse(file, image, "an 8-bit grey image");
  return image;
}

cv::Mat3b ReadColorImage(const std::filesystem::path& file) {
  cv::Mat image = Read(file);
  if (image.type() == CV_8UC3) return image;
  if (image.depth() != CV_8U || image.channels() == 2) Refuse(file, image, "an 8-bit colour image");
  cv::Mat3b color(image.size());
  const std::array<int, 6> from_to = image.channels() == 1 ? std::array<int, 6>{0, 0, 0, 1, 0, 2}
                                                           : std::array<int, 6>{0, 0, 1, 1, 2, 2};
  cv::mixChannels(&image, 1, &color, 1, from_to.data(), 3);
  return color;
}

cv::Mat1w ReadDepthImage(const std::filesystem::path& file) {
  cv::Mat image = Read(file);
  if (image.type() != CV_16UC1) Refuse(file, image, "a 16-bit single-channel depth image");
  // The largest value says that a measurement is out of range, or that there is none.
  image.setTo(0, image == std::numeric_limits<uint16_t>::max());
  return image;
}

void WritePng(const OutputPath& file, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  if (!cv::imencode(".png", image, bytes)) {
    throw InputError(file.path(), "cannot be encoded as PNG");
  }
  WriteFileAtomically(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace fenestra
