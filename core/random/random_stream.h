#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace fenestra {

class Pose;

/// A pure function from (seed, path, index) to random numbers; no state, no order of calls.
///
/// Numbers come from Philox4x32-10 (Salmon et al., "Parallel random numbers: as easy as 1, 2, 3",
/// SC 2011; the Random123 library). A stream is a 64-bit Philox key; a child's key is the cipher
/// of its purpose and index under the parent's key, so that streams of different paths are
/// independent. Normal variates are inverse CDFs of the uniforms, since the distributions of the
/// standard library differ between implementations.
class RandomStream {
 public:
  explicit RandomStream(uint64_t seed) : key_(seed) {}

  /// The stream for one purpose ("read_noise") and index (a replicate, an image, a camera).
  RandomStream Child(std::string_view purpose, uint64_t index = 0) const;

  /// Uniform in the open interval (0, 1), 52 bits.
  double Uniform(uint64_t index) const;

  /// Standard normal.
  double Normal(uint64_t index) const;

  /// out[i] = standard normal number `i` of a sequence of its own, in single precision:
  /// 32-bit uniforms, so |x| < 6.4. For images.
  void FillNormals(std::span<float> out) const;

  /// out[i] uniform in (0, 1), 24 bits.
  void FillUniforms(std::span<float> out) const;

  uint64_t key() const { return key_; }

 private:
  uint64_t key_;
};

/// A small displacement: a rotation vector and a translation, whose six components are independent
/// and normal with mean 0 and the given standard deviations [rad], [m].
Pose RandomPose(const RandomStream& stream, double rotation_rad, double translation_m);

/// The loops behind RandomStream's Fill functions, compiled for the widest vectors at hand. All
/// instruction sets give the same bits.

/// words[i] = word i of the blocks (j, 0, 0, use), j = 0, 1, …, that Philox4x32-10 makes of `key`:
/// four words to a block. Equal to Random123's.
void FillPhiloxWords(uint64_t key, uint32_t use, uint64_t first_block, std::span<uint32_t> words);

/// Standard normal variates of uniform 32-bit words: the quantile function PPND7 of M. J. Wichura,
/// "The percentage points of the normal distribution", AS 241, 1988, of the word's upper 31 bits as
/// a number in (0, 1/2], with the lowest bit as the sign. About 6 digits.
void NormalsOfWords(std::span<const uint32_t> words, std::span<float> normals);

}  // namespace fenestra
