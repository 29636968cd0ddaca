// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/triple.h"

#include <array>

namespace signorini
{
/// Positions of the nodes of a quadratic cell, numbered as in FileMesh::Cell; of a triangle the first six
/// [m].
using QuadraticCell = std::array<Triple, 10>;

double distance(const Triple &a, const Triple &b);

Triple midpoint(const Triple &a, const Triple &b);

/// det(x_1 − x_0, …, x_d − x_0): d! times the volume (area in 2-D), negative for an inverted cell.
double determinant(const std::array<Triple, 4> &corners, unsigned int dimension);

/// The least Jacobian determinant of the quadratic map at its nodes, relative to that of the straight cell of
/// the same corners: 1 for a straight cell, not positive for one that is folded.
double least_relative_jacobian(const QuadraticCell &cell, unsigned int dimension);

/// Ratio of the radii of the inscribed and the circumscribed sphere (circle), times the dimension: 1 for the
/// regular cell, 0 for a flat one.
double radius_ratio(const std::array<Triple, 4> &corners, unsigned int dimension);
} // namespace signorini
