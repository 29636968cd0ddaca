// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

namespace signorini
{
/// A vector over the degrees of freedom, distributed over the ranks.
using Vector = dealii::LinearAlgebra::distributed::Vector<double>;
} // namespace signorini
