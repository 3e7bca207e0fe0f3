#pragma once

#include <cstdint>
#include <span>

namespace fenestra {

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
