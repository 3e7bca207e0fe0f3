#!/usr/bin/env python3
"""Counts how often the true centroid lies within the ellipsoid that a detector states for 95 %.

    ./run run coverage && docs/coverage.py results/coverage/results.sqlite

Over the hits, by part, detector and levels; beside it the mean of the normalised squared error, which
is 3 for an honest covariance of a normal error.
"""
import json
import sqlite3
import sys

CHI2_OF_3_AT_95_PERCENT = 7.815


def solve(matrix, vector):
    """x of matrix x = vector, 3 by 3, by Cramer's rule."""
    def determinant(m):
        return (m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
                - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
                + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]))

    def replaced(column):
        return [[vector[i] if j == column else matrix[i][j] for j in range(3)] for i in range(3)]
    return [determinant(replaced(column)) / determinant(matrix) for column in range(3)]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rows = sqlite3.connect(f"file:{sys.argv[1]}?mode=ro", uri=True).execute(
        "SELECT part, detector, levels, centroid_error_x_mm, centroid_error_y_mm,"
        " centroid_error_z_mm, estimate_covariance_m2 FROM trials"
        " WHERE outcome = 'hit' AND estimate_covariance_m2 IS NOT NULL ORDER BY cell")
    squares = {}
    for part, detector, levels, *errors_mm, covariance in rows:
        error = [1e-3 * e for e in errors_mm]
        weighted = solve(json.loads(covariance), error)
        square = sum(e * w for e, w in zip(error, weighted))
        squares.setdefault((part, detector, levels), []).append(square)
    for (part, detector, levels), values in squares.items():
        within = sum(v <= CHI2_OF_3_AT_95_PERCENT for v in values)
        print(f"{part:12} {detector:14} {levels:24} {within:4} of {len(values):4} within,"
              f" mean square {sum(values) / len(values):6.2f}")


if __name__ == "__main__":
    main()
