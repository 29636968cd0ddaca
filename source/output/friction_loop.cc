// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/friction_loop.h"

#include "signorini/output/error_rows.h"

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
/// In the row nearest to that time.
template <int dim>
double rubbed_off_at(const Results<dim> &results, double time)
{
  return std::min_element(results.history.begin(), results.history.end(),
                          [time](const HistoryRow &one, const HistoryRow &other)
                          { return std::abs(one.time - time) < std::abs(other.time - time); })
      ->rubbed_off;
}
} // namespace

template <int dim>
std::vector<ErrorRow> compare_with_friction_loop(const Results<dim> &results)
{
  const BodyParameters &body = results.parameters->bodies.at(0);
  const double length = body.mesh.upper_corner[0] - body.mesh.lower_corner[0];
  const double end = results.history.back().time,
               period = results.parameters->exact_solution->values.at("Period");
  DraggedBar bar;
  bar.stiffness = body.material.youngs_modulus * results.body_volumes.at(0) / length;
  bar.pull = std::abs(results.total_load[0]);
  bar.friction =
      results.parameters->contact->friction->coefficient * std::abs(results.total_load[dim - 1]) / length;
  return {compare("energy rubbed off in a loop",
                  rubbed_off_at(results, end) - rubbed_off_at(results, end - period), bar.loss_of_loop()),
          compare("displacement of the loaded end", results.body_end_displacement.at(0)[0],
                  bar.end_displacement())};
}

template std::vector<ErrorRow> compare_with_friction_loop<2>(const Results<2> &);
template std::vector<ErrorRow> compare_with_friction_loop<3>(const Results<3> &);
} // namespace signorini
