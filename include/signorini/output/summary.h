// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/output/results.h"

#include <string>

namespace signorini
{
/// Writes summary.json; keys that do not apply are absent. Call on one rank. Throws FileError.
template <int dim>
void write_summary(const Results<dim> &results, const std::string &input, unsigned int n_ranks,
                   const std::string &directory);

/// Writes profile.csv: radius, pressure and exact pressure of every sampled point, for exact solutions with a profile.
template <int dim>
void write_profile(const Results<dim> &results, const std::string &directory);
} // namespace signorini
