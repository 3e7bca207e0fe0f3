#include "experiments/run/shard.h"

#include <fmt/format.h>

#include <charconv>

#include "core/io/input_error.h"

namespace fenestra {
namespace {

constexpr int kMostShards = 100'000;

}  // namespace

std::string Shard::ToString() const {
  return fmt::format("{}/{}", index, count);
}

Shard Shard::Parse(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), end, shard.index);
  if (index.ec == std::errc() && index.ptr != end && *index.ptr == '/') {
    const auto count = std::from_chars(index.ptr + 1, end, shard.count);
    const bool whole = count.ec == std::errc() && count.ptr == end;
    if (whole && shard.count >= 1 && shard.count <= kMostShards && shard.index >= 1 &&
        shard.index <= shard.count) {
      return shard;
    }
  }
  throw InputError("--shard", fmt::format("must be I/N with I from 1 to N and N up to {}, such as "
                                          "2/8, not '{}'",
                                          kMostShards, text));
}

std::vector<TrialKey> Shard::Of(std::span<const TrialKey> all) const {
  std::vector<TrialKey> share;
  const auto stride = static_cast<size_t>(count);
  share.reserve(all.size() / stride + 1);
  for (size_t i = static_cast<size_t>(index - 1); i < all.size(); i += stride) {
    share.push_back(all[i]);
  }
  return share;
}

}  // namespace fenestra
