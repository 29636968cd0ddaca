// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/results.h"

namespace signorini
{
/// A bar on a rigid rough plane, pulled to and fro at one end.
struct DraggedBar
{
  double stiffness = 0.; ///< EA of its section [N]
  double friction = 0.;  ///< at most, per length, q = μN/L [N/m]
  double pull = 0.;      ///< amplitude F, less than qL [N]

  /// F²/(2 EA q): how far the end has come at the amplitude [m].
  double end_displacement() const { return pull * pull / (2. * stiffness * friction); }

  /// 2F³/(3 EA q): what each loop between F and −F rubs off [J].
  double loss_of_loop() const { return 4. / 3. * pull * end_displacement(); }
};

/// Errors of a bar after a loop, against the bar as a line (doc/theory.md, section 10).
template <int dim>
std::vector<ErrorRow> compare_with_friction_loop(const Results<dim> &results);
} // namespace signorini
