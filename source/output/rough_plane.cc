// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/rough_plane.h"

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
double dot(const Triple &a, const Triple &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Without the part along `normal`, which has unit length.
Triple project(const Triple &vector, const Triple &normal)
{
  Triple in_plane = vector;
  for (unsigned int d = 0; d < 3; ++d)
    in_plane[d] -= dot(vector, normal) * normal[d];
  return in_plane;
}

Triple normalized(Triple vector)
{
  const double length = std::sqrt(dot(vector, vector));
  for (double &component : vector)
    component /= length;
  return vector;
}
} // namespace

Slide slide(double velocity, double acceleration, double braking, double T)
{
  Slide result;
  if (velocity != 0.)
  {
    const double total = acceleration - std::copysign(braking, velocity);
    const double stop = velocity * total < 0. ? std::min(T, -velocity / total) : T;
    result.way = velocity * stop + .5 * total * stop * stop;
    result.distance = std::abs(result.way);
    T -= stop;
  }
  const double from_rest = .5 * std::max(std::abs(acceleration) - braking, 0.) * T * T;
  result.way += std::copysign(from_rest, acceleration);
  result.distance += from_rest;
  return result;
}

template <int dim>
std::vector<ErrorRow> compare_with_rough_plane(const Results<dim> &results)
{
  const Parameters &parameters = *results.parameters;
  const BodyParameters &block = parameters.bodies.at(0);
  const Triple normal = normalized(parameters.obstacles.at(0).normal);
  const Triple down_slope = project(parameters.gravity, normal);
  const bool is_level = std::sqrt(dot(down_slope, down_slope)) < 1e-9 * -dot(parameters.gravity, normal);
  const Triple along = normalized(is_level ? block.initial_velocity : down_slope);
  const double braking = parameters.contact->friction->coefficient * -dot(parameters.gravity, normal);
  const Slide exact = slide(dot(block.initial_velocity, along), is_level ? 0. : dot(down_slope, along),
                            braking, results.history.back().time);

  const double way = dot(results.history.back().bodies.at(0).displacement, along);
  double length = 0.;
  for (unsigned int d = 0; d < dim; ++d)
    length += std::abs(along[d]) * (block.mesh.upper_corner[d] - block.mesh.lower_corner[d]);
  const double rubbed_off = results.energy.rubbed_off,
               exact_loss = results.body_masses.at(0) * braking * exact.distance;
  // What sticks has nothing to be relative to but itself.
  const double scale = exact.way != 0. ? std::abs(exact.way) : length;
  std::vector<ErrorRow> rows{{"way along the plane", way, exact.way, (way - exact.way) / scale}};
  if (exact_loss > 0.)
    rows.push_back({"energy rubbed off", rubbed_off, exact_loss, (rubbed_off - exact_loss) / exact_loss});
  return rows;
}

template std::vector<ErrorRow> compare_with_rough_plane<2>(const Results<2> &);
template std::vector<ErrorRow> compare_with_rough_plane<3>(const Results<3> &);
} // namespace signorini
