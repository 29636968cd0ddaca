// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/coupling/contact_term.h"

#include <deal.II/base/mpi.h>

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
  using dealii::Utilities::MPI::max;
  using dealii::Utilities::MPI::sum;
  const double deepest = max(total.max_penetration_over_thickness, communicator);
  const unsigned int this_rank = dealii::Utilities::MPI::this_mpi_process(communicator);
  const unsigned int deepest_rank =
      max(total.max_penetration_over_thickness == deepest ? this_rank : 0u, communicator);
  MPI_Bcast(&total.deepest_body, 1, MPI_UNSIGNED, static_cast<int>(deepest_rank), communicator);
  MPI_Bcast(&total.deepest_thickness, 1, MPI_DOUBLE, static_cast<int>(deepest_rank), communicator);
  MPI_Bcast(total.deepest_position.data(), dim, MPI_DOUBLE, static_cast<int>(deepest_rank), communicator);
  total.max_penetration_over_thickness = deepest;
  total.deepest_position += origin;
  total.max_penetration = max(total.max_penetration, communicator);
  total.max_pressure = max(total.max_pressure, communicator);
  total.max_stiffness = max(total.max_stiffness, communicator);
  total.area = sum(total.area, communicator);
  total.n_pairs = sum(total.n_pairs, communicator);
  total.n_active = sum(total.n_active, communicator);
  MPI_Allreduce(MPI_IN_PLACE, total.resultants.data(), static_cast<int>(dim * total.resultants.size()),
                MPI_DOUBLE, MPI_SUM, communicator);
  return total;
}

template <int dim>
contact::PairForces<dim> ContactTerm<dim>::sum(const contact::PairForces<dim> &own) const
{
  contact::PairForces<dim> total;
  for (const auto table : {&contact::PairForces<dim>::bodies, &contact::PairForces<dim>::obstacles})
  {
    std::vector<double> packed;
    for (const auto &[pair, force] : own.*table)
    {
      packed.insert(packed.end(), {static_cast<double>(pair.first), static_cast<double>(pair.second)});
      packed.insert(packed.end(), force.begin(), force.end());
    }
    for (const std::vector<double> &of_rank : dealii::Utilities::MPI::all_gather(communicator, packed))
      for (auto value = of_rank.begin(); value != of_rank.end(); value += 2 + dim)
        (total.*table)
            .try_emplace({static_cast<unsigned int>(value[0]), static_cast<unsigned int>(value[1])},
                         SpatialVector<dim>::Zero())
            .first->second += Eigen::Map<const SpatialVector<dim>>(&value[2]);
  }
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
