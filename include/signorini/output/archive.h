// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/exceptions.h"
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

/// This rank's entries of a vector, which keeps its layout (collective). Throws FileError if the archive has
/// another number of them.
template <typename Archive>
void serialize(Archive &archive, signorini::Vector &vector, unsigned int /*version*/)
{
  std::size_t n_entries = vector.locally_owned_size();
  bool has_ghosts = vector.has_ghost_elements();
  archive &n_entries &has_ghosts;
  if (n_entries != vector.locally_owned_size())
    throw signorini::FileError(
        signorini::Complaint("the mesh is not that of the checkpoint")
            .found(std::to_string(vector.locally_owned_size()) + " degrees of freedom on a rank")
            .expected(std::to_string(n_entries))
            .advise("take the mesh files that the run began with, or run again from the start"));
  archive &make_array(vector.begin(), n_entries);
  if (!Archive::is_loading::value)
    return;
  if (has_ghosts)
    vector.update_ghost_values();
  else
    vector.zero_out_ghost_values();
}
} // namespace boost::serialization
