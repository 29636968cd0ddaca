// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/surface_map.h"

#include <algorithm>
#include <unordered_map>

namespace signorini
{
template <int dim>
SurfaceMap<dim>::SurfaceMap(const Scene<dim> &scene, const Discretization<dim> &the_discretization)
    : NodeMap<dim>(the_discretization)
{
  contact_surface.n_bodies = scene.n_bodies();
  std::vector<OuterFacet<dim>> own = collect_outer_facets(the_discretization);
  for (OuterFacet<dim> &outer : own)
  {
    outer.facet.youngs_modulus = scene.materials[outer.facet.body].youngs_modulus;
    outer.facet.density = scene.materials[outer.facet.body].density;
  }
  number_facets(own);
  std::vector<typename NodeMap<dim>::NodeDofs> dofs_of_nodes;
  append(own, dofs_of_nodes);
  n_facets = static_cast<unsigned int>(own.size());
  n_nodes_of_own = contact_surface.n_nodes();
  find_extremes();
  contact_surface.origin =
      move_to_middle(contact_surface.reference_positions, the_discretization.communicator());
  this->set_nodes(std::move(dofs_of_nodes));
}

template <int dim>
void SurfaceMap<dim>::number_facets(std::vector<OuterFacet<dim>> &own)
{
  const MPI_Comm &communicator = this->discretization->communicator();
  const auto n_own = static_cast<unsigned int>(own.size());
  unsigned int number = 0; // the sum over the ranks before
  MPI_Scan(&n_own, &number, 1, MPI_UNSIGNED, MPI_SUM, communicator);
  number -= n_own;
  for (OuterFacet<dim> &outer : own)
    outer.facet.number = number++;
  n_facets_of_all = dealii::Utilities::MPI::sum(n_own, communicator);
}

template <int dim>
void SurfaceMap<dim>::find_extremes()
{
  using dealii::Utilities::MPI::max;
  using dealii::Utilities::MPI::min;
  const MPI_Comm &communicator = this->discretization->communicator();
  auto &extremes = contact_surface.elsewhere;
  extremes.layer_thickness = min(contact_surface.smallest_layer_thickness(), communicator);
  extremes.room = min(contact_surface.smallest_room(), communicator);
  for (const FacetType type : {FacetType::tensor_product, FacetType::triangle})
  {
    const auto &facets = contact_surface.facets;
    const bool is_here = std::any_of(facets.begin(), facets.end(),
                                     [type](const Facet<dim> &facet) { return facet.type == type; });
    if (max(static_cast<int>(is_here), communicator) == 1)
    {
      FacetElement<dim> element;
      element.degree = this->discretization->degree;
      element.type = type;
      extremes.elements.push_back(element);
    }
  }
}

template <int dim>
void SurfaceMap<dim>::append(const std::vector<OuterFacet<dim>> &facets,
                             std::vector<typename NodeMap<dim>::NodeDofs> &dofs_of_nodes)
{
  std::unordered_map<dealii::types::global_dof_index, unsigned int> node_of_dof;
  for (unsigned int node = 0; node < dofs_of_nodes.size(); ++node)
    node_of_dof[dofs_of_nodes[node][0]] = node;
  for (const OuterFacet<dim> &outer : facets)
  {
    contact_surface.facets.push_back(outer.facet);
    for (unsigned int i = 0; i < outer.nodes.size(); ++i)
    {
      const typename OuterFacet<dim>::Node &node = outer.nodes[i];
      const auto [entry, is_new] = node_of_dof.emplace(node.dofs[0], contact_surface.n_nodes());
      contact_surface.facets.back().nodes[i] = entry->second;
      if (is_new)
      {
        contact_surface.reference_positions.push_back(node.position);
        dofs_of_nodes.push_back(node.dofs);
      }
    }
  }
}

template <int dim>
void SurfaceMap<dim>::pack(unsigned int facet, std::vector<double> &packed) const
{
  OuterFacet<dim> outer;
  outer.facet = contact_surface.facets[facet];
  for (unsigned int i = 0; i < outer.facet.n_nodes(); ++i)
  {
    const unsigned int node = outer.facet.nodes[i];
    outer.nodes.push_back({this->node_dofs(node), contact_surface.reference_positions[node]});
  }
  outer.pack(packed);
}

template <int dim>
void SurfaceMap<dim>::exchange(const std::map<unsigned int, std::vector<unsigned int>> &given)
{
  contact_surface.facets.resize(n_facets);
  contact_surface.reference_positions.resize(n_nodes_of_own);
  std::vector<typename NodeMap<dim>::NodeDofs> dofs_of_nodes;
  for (unsigned int node = 0; node < n_nodes_of_own; ++node)
    dofs_of_nodes.push_back(this->node_dofs(node));
  std::map<unsigned int, std::vector<double>> messages;
  for (const auto &[rank, facets] : given)
    for (const unsigned int facet : facets)
      pack(facet, messages[rank]);
  std::vector<OuterFacet<dim>> received;
  for (const auto &[rank, message] :
       dealii::Utilities::MPI::some_to_some(this->discretization->communicator(), messages))
    for (auto value = message.begin(); value != message.end();)
    {
      received.push_back(OuterFacet<dim>::unpack(value));
      received.back().facet.owned = false;
    }
  append(received, dofs_of_nodes);
  this->set_nodes(std::move(dofs_of_nodes));
}

template <int dim>
std::vector<SpatialVector<dim>> SurfaceMap<dim>::positions(const Vector &displacement) const
{
  std::vector<SpatialVector<dim>> x = this->gather(displacement);
  for (unsigned int node = 0; node < x.size(); ++node)
    x[node] += contact_surface.reference_positions[node];
  return x;
}

template class SurfaceMap<2>;
template class SurfaceMap<3>;
} // namespace signorini
