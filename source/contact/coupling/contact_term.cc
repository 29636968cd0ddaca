// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/coupling/contact_term.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

namespace signorini
{
template <int dim>
ContactTerm<dim>::ContactTerm(const std::string &term_name, bool is_an_external_term,
                              const MPI_Comm &mpi_communicator)
    : ForceTerm(term_name, Kind::contact, is_an_external_term), communicator(mpi_communicator)
{
}

template <int dim>
contact::ContactMeasures<dim> ContactTerm<dim>::sum(contact::ContactMeasures<dim> total,
                                                    const SpatialVector<dim> &origin) const
{
  struct
  {
    double share;
    int rank;
  } deepest{total.max_penetration_over_thickness,
            static_cast<int>(dealii::Utilities::MPI::this_mpi_process(communicator))};
  MPI_Allreduce(MPI_IN_PLACE, &deepest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, communicator);
  std::array<double, dim + 2> place{static_cast<double>(total.deepest_body), total.deepest_thickness};
  std::copy(total.deepest_position.begin(), total.deepest_position.end(), place.begin() + 2);
  MPI_Bcast(place.data(), dim + 2, MPI_DOUBLE, deepest.rank, communicator);
  total.max_penetration_over_thickness = deepest.share;
  total.deepest_body = static_cast<unsigned int>(place[0]);
  total.deepest_thickness = place[1];
  total.deepest_position = origin + Eigen::Map<const SpatialVector<dim>>(&place[2]);

  std::array<double, 3> largest{total.max_penetration, total.max_pressure, total.max_stiffness};
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), 3, MPI_DOUBLE, MPI_MAX, communicator);
  total.max_penetration = largest[0];
  total.max_pressure = largest[1];
  total.max_stiffness = largest[2];

  std::vector<double> sums{total.area, static_cast<double>(total.n_pairs),
                           static_cast<double>(total.n_active)};
  for (const SpatialVector<dim> &resultant : total.resultants)
    sums.insert(sums.end(), resultant.begin(), resultant.end());
  dealii::Utilities::MPI::sum(sums, communicator, sums);
  total.area = sums[0];
  total.n_pairs = static_cast<unsigned int>(sums[1]);
  total.n_active = static_cast<unsigned int>(sums[2]);
  for (std::size_t body = 0; body < total.resultants.size(); ++body)
    total.resultants[body] = Eigen::Map<const SpatialVector<dim>>(&sums[3 + dim * body]);
  return total;
}

template <int dim>
contact::PairForces<dim> ContactTerm<dim>::sum(const contact::PairForces<dim> &own) const
{
  using Forces = contact::PairForces<dim>;
  constexpr std::array<typename Forces::Table Forces::*, 2> tables{&Forces::bodies, &Forces::obstacles};
  std::vector<double> packed; // the table, the pair, the force
  for (unsigned int table = 0; table < tables.size(); ++table)
    for (const auto &[pair, force] : own.*tables[table])
    {
      packed.insert(packed.end(), {static_cast<double>(table), static_cast<double>(pair.first),
                                   static_cast<double>(pair.second)});
      packed.insert(packed.end(), force.begin(), force.end());
    }
  Forces total;
  for (const std::vector<double> &of_rank : dealii::Utilities::MPI::all_gather(communicator, packed))
    for (auto value = of_rank.begin(); value != of_rank.end(); value += 3 + dim)
      (total.*tables[static_cast<unsigned int>(value[0])])
          .try_emplace({static_cast<unsigned int>(value[1]), static_cast<unsigned int>(value[2])},
                       SpatialVector<dim>::Zero())
          .first->second += Eigen::Map<const SpatialVector<dim>>(&value[3]);
  return total;
}

template <int dim>
void ContactTerm<dim>::spread(const std::vector<double> &nodal, Vector &values) const
{
  std::vector<SpatialVector<dim>> equal;
  for (const double value : nodal)
    equal.push_back(SpatialVector<dim>::Constant(value));
  nodes().add_to_owners(equal, values);
}

template <int dim>
void ContactTerm<dim>::add_block(const std::vector<unsigned int> &block_nodes, const Eigen::MatrixXd &block,
                                 TangentSystem &system) const
{
  const unsigned int n = block.rows();
  dealii::FullMatrix<double> matrix(n, n);
  dealii::Vector<double> zero(n);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      matrix(i, j) = block(i, j);
  system.constraints->distribute_local_to_global(matrix, zero, nodes().collect_dofs(block_nodes),
                                                 system.matrix, system.right_hand_side);
}

template class ContactTerm<2>;
template class ContactTerm<3>;
} // namespace signorini
