// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/spatial_vector.h"
#include "signorini/parameters/expression.h"

#include <optional>
#include <string>
#include <vector>

namespace signorini
{
/// A displacement that is another one from one moment to the next.
struct ObstacleJump
{
  double time; ///< [s]
  double size; ///< [m]
};

/// How an obstacle moves as a whole from the place it is given at, whatever touches it.
template <int dim>
class ObstacleMotion
{
public:
  /// `formulas`: dim formulas of t [m], or none for an obstacle that is fixed. `description`: file, line and
  /// name, for messages.
  ObstacleMotion(const std::vector<std::string> &formulas, std::string description, double end_time);

  bool is_fixed() const { return formulas.empty(); }

  /// From the place it is given at [m]. Throws InputError if a formula is not finite then.
  SpatialVector<dim> displacement(double t) const;

  /// From the displacements at t and a millionth of the run before [m/s]: of the formula alone, so it does
  /// not depend on steps, and knows nothing of a mesh that has changed.
  SpatialVector<dim> velocity(double t) const;

  /// The largest jump between two times, if there is one that is more than a hundredth of the way between
  /// them.
  std::optional<ObstacleJump> find_jump(double start, double end) const;

  /// File, line and name, for messages.
  const std::string &place() const { return description; }

private:
  std::vector<Expression> formulas;
  std::string description;
  double interval; ///< for differences [s]
};
} // namespace signorini
