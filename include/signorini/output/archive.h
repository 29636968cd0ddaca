// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/types.h"

#include <Eigen/Core>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

/// How the matrices and vectors of the program go into boost's archives. Classes that have something to
/// remember tell what by a member `serialize`.
namespace boost::serialization
{
/// Matrices of fixed size.
template <typename Archive, typename Number, int n_rows, int n_columns, int options, int max_n_rows,
          int max_n_columns>
void serialize(Archive &archive,
               Eigen::Matrix<Number, n_rows, n_columns, options, max_n_rows, max_n_columns> &matrix,
               unsigned int /*version*/)
{
  static_assert(n_rows > 0 && n_columns > 0);
  archive &make_array(matrix.data(), matrix.size());
}

/// This rank's entries of a vector, which keeps its layout: that of the archive (collective).
template <typename Archive>
void serialize(Archive &archive, signorini::Vector &vector, unsigned int /*version*/)
{
  std::size_t n_entries = vector.locally_owned_size();
  bool has_ghosts = vector.has_ghost_elements();
  archive &n_entries &has_ghosts;
  Assert(n_entries == vector.locally_owned_size(),
         dealii::ExcDimensionMismatch(n_entries, vector.locally_owned_size()));
  archive &make_array(vector.begin(), n_entries);
  if (!Archive::is_loading::value)
    return;
  if (has_ghosts)
    vector.update_ghost_values();
  else
    vector.zero_out_ghost_values();
}
} // namespace boost::serialization
