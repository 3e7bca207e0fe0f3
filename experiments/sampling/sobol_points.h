#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "core/random/random_stream.h"

namespace fenestra {

/// OpenTURNS has direction numbers for so many dimensions.
inline constexpr int kMostSobolDimensions = 1111;

/// The first `count` points of the Sobol sequence, the origin among them, one a row; multiples of
/// 2⁻³². Every 2^m points from the start are a digital net, in Gray code order.
/// Direction numbers: S. Joe and F. Y. Kuo, "Constructing Sobol sequences with better
/// two-dimensional projections", SIAM J. Sci. Comput. 30, 2008, from OpenTURNS.
/// Domain: 1 ≤ dimensions ≤ kMostSobolDimensions, 0 ≤ count ≤ 2³².
Eigen::MatrixXd SobolPoints(int count, int dimensions);

/// Owen's nested uniform scrambling of one coordinate in [0, 1): each of its first 32 binary digits
/// is flipped or not by a coin that depends on the digits before it; what follows is `tail`, in
/// (0, 1). All points whose coordinate has the same stream keep their equidistribution, each is
/// uniform on (0, 1) for itself.
/// Source: A. B. Owen, "Randomly permuted (t,m,s)-nets and (t,s)-sequences", 1995.
double OwenScrambled(double coordinate, const RandomStream& coins, double tail);

}  // namespace fenestra
