// SPDX-License-Identifier: LGPL-2.1-or-later
// What exact solutions need of the kind of run.
#include "signorini/parameters/run_parameters.h"
#include "signorini/parameters/scene_needs.h"

#include <variant>

namespace signorini
{
namespace
{
/// A run of one of the kinds for which `is_right(solver)`.
template <typename IsRight>
SceneNeed run_for_which(const std::string &text, const IsRight &is_right)
{
  return {text,
          [is_right](const ParameterText &file, const Parameters &parameters) -> std::optional<SceneFault>
          {
            if (is_right(parameters.solver))
              return {};
            const std::string found = name_of(parameters.solver);
            return SceneFault{file.where(found), found};
          }};
}

} // namespace

SceneNeed quasi_static_run()
{
  return run_for_which("'Quasi-static'", [](const SolverParameters &solver)
                       { return std::holds_alternative<QuasiStaticParameters>(solver); });
}

SceneNeed run_in_motion()
{
  return run_for_which("'Explicit' or 'Implicit'", [](const SolverParameters &solver)
                       { return !std::holds_alternative<QuasiStaticParameters>(solver); });
}
} // namespace signorini
