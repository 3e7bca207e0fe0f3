#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fenestra {

/// " Did you mean 'x'?" for the allowed word that is nearest to `word` by edit distance with
/// transpositions, or "" where none is near (more than a third of its letters differ).
std::string DidYouMean(std::string_view word, std::span<const std::string> allowed);

}  // namespace fenestra
