#include "renderers/exr_io.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "core/io/faults.h"
#include "core/io/temporary_files.h"

namespace fenestra {
namespace {

constexpr int kLargestSide_px = 16384;

// An output stream into a string, so that the file can appear by rename.
class StringStream : public Imf::OStream {
 public:
  StringStream() : Imf::OStream("memory") {}

  void write(const char c[], int n) override {
    const auto count = static_cast<size_t>(n);
    if (position_ + count > bytes_.size()) bytes_.resize(position_ + count);
    std::memcpy(bytes_.data() + position_, c, count);
    position_ += count;
  }
  uint64_t tellp() override { return position_; }
  void seekp(uint64_t position) override { position_ = position; }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  size_t position_ = 0;
};

void Check(const std::filesystem::path& file, const std::vector<ExrChannel>& channels) {
  Faults faults(file.string());
  faults.Require(!channels.empty() && !channels.front().values.empty(), "an image needs pixels");
  std::set<std::string> names;
  for (const ExrChannel& channel : channels) {
    faults.Require(!channel.name.empty(), "a channel has no name");
    faults.Require(names.insert(channel.name).second, "two channels '" + channel.name + "'");
    faults.Require(channel.values.size() == channels.front().values.size(),
                   "channel '" + channel.name + "' has another size than the first");
  }
  faults.ThrowIfAny();
}

// A slice of whose pixels the first is the data window's upper left corner.
Imf::Slice SliceOf(const cv::Mat1f& values, int left, int top) {
  // OpenEXR takes a mutable pointer for reading as well as for writing.
  char* data = reinterpret_cast<char*>(const_cast<uchar*>(values.data));
  const size_t row_bytes = values.step[0];
  const auto before = static_cast<ptrdiff_t>(left) * static_cast<ptrdiff_t>(sizeof(float)) +
                      static_cast<ptrdiff_t>(top) * static_cast<ptrdiff_t>(row_bytes);
  return Imf::Slice(Imf::FLOAT, data - before, sizeof(float), row_bytes);
}

ExrImage ReadOrThrow(const std::filesystem::path& file, const ExrReadOptions& options) {
  Imf::InputFile input(file.c_str(), 0);
  const Imath::Box2i window = input.header().dataWindow();
  const int64_t width = int64_t{window.max.x} - window.min.x + 1;
  const int64_t height = int64_t{window.max.y} - window.min.y + 1;
  if (width > kLargestSide_px || height > kLargestSide_px) {
    throw InputError(
        file, fmt::format("{} x {} px are more than {} px a side", width, height, kLargestSide_px));
  }
  ExrImage image;
  Imf::FrameBuffer frame;
  const Imf::ChannelList& list = input.header().channels();
  int64_t channels = 0;
  for (auto entry = list.begin(); entry != list.end(); ++entry) ++channels;
  if (width * height > options.most_values / std::max<int64_t>(channels, 1)) {
    throw InputError(file, fmt::format("{} channels of {} x {} px are more than {} values",
                                       channels, width, height, options.most_values));
  }
  for (auto entry = list.begin(); entry != list.end(); ++entry) {
    if (entry.channel().xSampling != 1 || entry.channel().ySampling != 1) {
      throw InputError(file, fmt::format("channel '{}' is subsampled", entry.name()));
    }
    cv::Mat1f values(static_cast<int>(height), static_cast<int>(width));
    frame.insert(entry.name(), SliceOf(values, window.min.x, window.min.y));
    image.channels.push_back({entry.name(), values});
  }
  input.setFrameBuffer(frame);
  input.readPixels(window.min.y, window.max.y);
  for (auto entry = input.header().begin(); entry != input.header().end(); ++entry) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&entry.attribute());
    if (text != nullptr) image.metadata[entry.name()] = text->value();
  }
  return image;
}

}  // namespace

void WriteExr(const OutputPath& file, const std::vector<ExrChannel>& channels,
              const std::map<std::string, std::string>& metadata) {
  Check(file.path(), channels);
  const cv::Size size = channels.front().values.size();
  StringStream stream;
  try {
    Imf::Header header(size.width, size.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, text] : metadata) {
      if (header.find(name) != header.end()) {
        throw InputError(file.path(), "metadata '" + name + "' is a reserved name");
      }
      header.insert(name, Imf::StringAttribute(text));
    }
    Imf::FrameBuffer frame;
    for (const ExrChannel& channel : channels) {
      header.channels().insert(channel.name, Imf::Channel(Imf::FLOAT));
      frame.insert(channel.name, SliceOf(channel.values, 0, 0));
    }
    Imf::OutputFile output(stream, header, 0);
    output.setFrameBuffer(frame);
    output.writePixels(size.height);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(file.path(), error.what());
  }
  WriteFileAtomically(file, stream.bytes());
}

ExrImage ReadExr(const std::filesystem::path& file, const ExrReadOptions& options) {
  try {
    return ReadOrThrow(file, options);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(file, error.what());
  }
}

}  // namespace fenestra
