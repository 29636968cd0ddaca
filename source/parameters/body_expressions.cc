// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/body_expressions.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/body_parameters.h"
#include "signorini/parameters/expression.h"
#include "signorini/parameters/mesh_parameters.h"

#include <fmt/format.h>

#include <cmath>

namespace signorini
{
namespace
{
/// Rodrigues' formula.
Triple rotate(const PlacementParameters &placement, const Triple &x)
{
  constexpr double degree = 3.14159265358979323846 / 180.;
  const double angle = placement.rotation_angle * degree;
  Triple axis = placement.rotation_axis;
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  for (double &component : axis)
    component /= length;
  const double along = axis[0] * x[0] + axis[1] * x[1] + axis[2] * x[2];
  Triple result{};
  for (unsigned int c = 0; c < 3; ++c)
  {
    const unsigned int d = (c + 1) % 3;
    const unsigned int e = (c + 2) % 3;
    const double cross = axis[d] * x[e] - axis[e] * x[d];
    result[c] = std::cos(angle) * x[c] + std::sin(angle) * cross + (1. - std::cos(angle)) * along * axis[c];
  }
  return result;
}

/// A formula with all that is needed to complain about it.
struct PlacedFormula
{
  std::string formula;
  std::string name;  ///< subsection and key
  std::string where; ///< file and line
};

Expression make_expression(const PlacedFormula &formula)
{
  try
  {
    return Expression(formula.formula);
  }
  catch (const InputError &error)
  {
    throw InputError(
        Complaint(error.complaint()).at(formula.where).found(formula.name + " = " + formula.formula));
  }
}

/// Throws for a value that is not finite at one of the points, at the start or at the end.
void check_values(const PlacedFormula &formula, const Expression &expression,
                  const std::vector<Triple> &points, const double end_time)
{
  for (const double t : {0., end_time})
    for (const Triple &x : points)
      if (const double value = expression.value(x, t); !std::isfinite(value))
        throw InputError(
            Complaint(fmt::format("the expression is {} at x = {}, y = {}, z = {}, t = {}",
                                  std::isnan(value) ? "not a number" : "infinite", x[0], x[1], x[2], t))
                .at(formula.where)
                .found(formula.name + " = " + formula.formula)
                .expected("finite values wherever it is used")
                .advise("correct the formula, or restrict it with if(condition, value, other)"));
}

void check_formula(const PlacedFormula &formula, const std::vector<Triple> &points,
                   const unsigned int dimension, const double end_time)
{
  const Expression expression = make_expression(formula);
  if (dimension == 2 && expression.uses("z"))
    throw InputError(Complaint("the expression uses the variable z, which two dimensions do not have")
                         .at(formula.where)
                         .found(formula.name + " = " + formula.formula)
                         .expected("a formula of x, y, t")
                         .advise("write y for the vertical coordinate, or set Dimension = 3"));
  check_values(formula, expression, points, end_time);
}
} // namespace

Triple place(const PlacementParameters &placement, const Triple &x)
{
  Triple result = rotate(placement, x);
  for (unsigned int c = 0; c < 3; ++c)
    result[c] = placement.shift[c] + placement.scale * result[c];
  return result;
}

void check_expressions(const ParameterText &text, const BodyParameters &body, const unsigned int dimension,
                       const double end_time)
{
  const auto placed_points = [&](const std::string &boundary)
  {
    std::vector<Triple> points = boundary_points(body.mesh, dimension, boundary);
    for (Triple &point : points)
      point = place(body.placement, point);
    return points;
  };
  for (const SupportParameters &support : body.supports)
    for (unsigned int c = 0; c < dimension; ++c)
      if (support.displacement[c])
      {
        const std::string path = body_subsection(body.name) + "/Support " + support.boundary;
        const std::string key(1, "xyz"[c]);
        check_formula({*support.displacement[c], join_path(path, key), text.where(path, key)},
                      placed_points(support.boundary), dimension, end_time);
      }
  for (const LoadParameters &load : body.loads)
    for (unsigned int c = 0; c < dimension; ++c)
    {
      const std::string path = body_subsection(body.name) + "/Load " + load.boundary;
      check_formula({load.traction[c], path + "/Traction", text.where(path, "Traction")},
                    placed_points(load.boundary), dimension, end_time);
    }
}

void check_motion(const ParameterText &text, const ObstacleParameters &obstacle, const double end_time)
{
  constexpr double round_off = 1e-12;
  const std::string path = "Obstacle " + obstacle.name, key = "Displacement";
  for (const std::string &component : obstacle.displacement)
  {
    const PlacedFormula formula{component, join_path(path, key), text.where(path, key)};
    const Expression expression = make_expression(formula);
    const auto complain = [&](const std::string &what)
    { return Complaint(what).at(formula.where).found(formula.name + " = " + formula.formula); };
    for (const char *const variable : {"x", "y", "z"})
      if (expression.uses(variable))
        throw InputError(complain(fmt::format("the motion of an obstacle depends on {}", variable))
                             .expected("a formula of t: an obstacle is rigid, and does not turn")
                             .advise("write how it moves as a whole, such as -0.1*t"));
    check_values(formula, expression, {{}}, end_time);
    const double start = expression.value({}, 0.);
    if (std::abs(start) > round_off * std::abs(expression.value({}, end_time)))
      throw InputError(complain(fmt::format("the displacement of obstacle '{}' starts at {:.6g} m, not 0",
                                            obstacle.name, start))
                           .expected("0 at t = 0")
                           .advise("let it grow with t, and give the place to start from by its other keys"));
  }
}
} // namespace signorini
