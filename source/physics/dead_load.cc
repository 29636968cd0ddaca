// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/physics/dead_load.h"

#include "signorini/base/collective_error.h"
#include "signorini/discretization/scene_mesh.h"

#include <deal.II/fe/fe_values.h>

namespace signorini
{
template <int dim>
DeadLoad<dim>::DeadLoad(const Scene<dim> &the_scene, const Discretization<dim> &the_discretization,
                        WeightShares shares)
    : ForceTerm("loads", Kind::load, true), scene(&the_scene), discretization(&the_discretization),
      weight(the_discretization.make_vector())
{
  if (scene->gravity.norm() > 0.)
    add_weight(shares);
  discretization->collect(weight);
  collect_points();
}

template <int dim>
void DeadLoad<dim>::add_weight(WeightShares shares)
{
  const CellTable<dim> &cells = discretization->cells;
  for (unsigned int cell = 0; cell < cells.n_cells; ++cell)
  {
    const double *volumes = shares == WeightShares::lumped_mass ? cells.cell_nodal_measures(cell)
                                                                : cells.cell_shape_integrals(cell);
    for (unsigned int i = 0; i < cells.n_cell_dofs(cell); ++i)
      weight.local_element(cells.cell_dofs(cell)[i]) +=
          scene->materials[cells.bodies[cell]].density * scene->gravity[i % dim] * volumes[i / dim];
  }
}

template <int dim>
void DeadLoad<dim>::collect_points()
{
  std::multimap<dealii::types::boundary_id, unsigned int> loaded;
  for (unsigned int l = 0; l < scene->loads.size(); ++l)
    loaded.emplace(global_boundary_id(scene->loads[l].body, scene->loads[l].boundary_id), l);
  for (const MeshPart<dim> *part : discretization->parts)
    collect_points_of(*part, loaded);
}

template <int dim>
void DeadLoad<dim>::collect_points_of(const MeshPart<dim> &part,
                                      const std::multimap<dealii::types::boundary_id, unsigned int> &loaded)
{
  const auto &element = part.element;
  const dealii::Quadrature<dim - 1> quadrature = part.face_gauss_rule(element.degree + 1);
  dealii::FEFaceValues<dim> values(part.mapping(), element, quadrature,
                                   dealii::update_values | dealii::update_JxW_values |
                                       dealii::update_quadrature_points);
  std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
  for (const auto &cell : part.own_cells())
    for (const unsigned int f : cell->face_indices())
    {
      if (!cell->face(f)->at_boundary())
        continue;
      const auto [first, last] = loaded.equal_range(cell->face(f)->boundary_id());
      if (first == last)
        continue;
      values.reinit(cell, f);
      part.get_dof_indices(cell, dofs);
      for (auto load = first; load != last; ++load)
        for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          LoadedPoint point{load->second, values.quadrature_point(q), {}, {}};
          for (unsigned int i = 0; i < dofs.size(); ++i)
            if (element.has_support_on_face(i, f))
            {
              point.weights.emplace_back(weight.get_partitioner()->global_to_local(dofs[i]),
                                         values.shape_value(i, q) * values.JxW(q));
              point.components.push_back(element.system_to_component_index(i).first);
            }
          points.push_back(std::move(point));
        }
    }
}

template <int dim>
void DeadLoad<dim>::add_own_tractions(double time)
{
  for (const LoadedPoint &point : points)
  {
    SpatialVector<dim> traction;
    for (unsigned int d = 0; d < dim; ++d)
      traction[d] = evaluate(scene->loads[point.load].traction[d], scene->loads[point.load].description,
                             point.position, time);
    for (unsigned int i = 0; i < point.weights.size(); ++i)
      forces.local_element(point.weights[i].first) += point.weights[i].second * traction[point.components[i]];
  }
}

template <int dim>
void DeadLoad<dim>::update(const State &state)
{
  forces.reinit(weight);
  throw_together(discretization->communicator(), [&]() { add_own_tractions(state.time); });
  discretization->collect(forces);
  forces += weight;
  work = forces * state.displacement;
}

template <int dim>
double DeadLoad<dim>::energy() const
{
  return -work;
}

template <int dim>
void DeadLoad<dim>::add_force(Vector &force) const
{
  for (unsigned int i = 0; i < forces.locally_owned_size(); ++i)
    force.local_element(i) += forces.local_element(i);
}

template class DeadLoad<2>;
template class DeadLoad<3>;
} // namespace signorini
