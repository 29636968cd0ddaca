// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/simplex_search.h"

#include "signorini/contact/geometry/simplex_overlap.h"
#include "signorini/contact/search/box_tree.h"

#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <stdexcept>

namespace signorini::contact
{
namespace
{
/// Whether all vertices of `other` lie farther than `distance` beyond one and the same face of `shape`.
template <int dim>
bool has_separating_face(const SimplexShape<dim> &shape, const SimplexShape<dim> &other, double distance)
{
  Eigen::Matrix<double, dim + 1, 1> highest = shape.coordinates(other.vertices[0]);
  for (unsigned int b = 1; b <= dim; ++b)
    highest = highest.cwiseMax(shape.coordinates(other.vertices[b]));
  for (unsigned int a = 0; a <= dim; ++a)
    if (highest[a] < -distance * shape.gradients[a].norm())
      return true;
  return false;
}
} // namespace

/// Positions and boxes at one time.
template <int dim>
struct SimplexSearch<dim>::Configuration
{
  Positions vertices;
  std::vector<BoundingBox<dim>> simplices;
  std::vector<BoundingBox<dim>> bodies;

  Configuration(const ContactVolume<dim> &volume, const Positions &positions)
      : vertices(volume.vertex_positions(positions)), bodies(volume.n_bodies)
  {
    simplices.reserve(volume.simplices.size());
    for (const Simplex<dim> &simplex : volume.simplices)
    {
      simplices.emplace_back();
      for (const unsigned int vertex : simplex.vertices)
        simplices.back().extend(vertices[vertex]);
      bodies[simplex.body].extend(simplices.back());
    }
  }

  SimplexShape<dim> shape(const Simplex<dim> &simplex) const
  {
    std::array<SpatialVector<dim>, dim + 1> x;
    for (unsigned int a = 0; a <= dim; ++a)
      x[a] = vertices[simplex.vertices[a]];
    return make_simplex_shape<dim>(x);
  }
};

template <int dim>
SimplexSearch<dim>::SimplexSearch(const ContactVolume<dim> &contact_volume, double skin_thickness,
                                  IsAllowedPair is_allowed_pair)
    : volume(contact_volume), skin(skin_thickness), record(skin), is_allowed(std::move(is_allowed_pair)),
      simplices_of_body(contact_volume.n_bodies)
{
  if (!(skin > 0.))
    throw std::invalid_argument("The skin of a search must be positive.");
  for (unsigned int i = 0; i < volume.simplices.size(); ++i)
    simplices_of_body.at(volume.simplices[i].body).push_back(i);
}

template <int dim>
void SimplexSearch<dim>::rebuild(const Positions &positions)
{
  const Configuration configuration(volume, positions);
  std::vector<unsigned int> all_bodies(volume.n_bodies);
  for (unsigned int body = 0; body < volume.n_bodies; ++body)
    all_bodies[body] = body;
  const BoxTree<dim> bodies = make_tree<dim>(configuration.bodies, all_bodies);

  pairs_.clear();
  std::vector<unsigned int> near;
  for (unsigned int body = 0; body < volume.n_bodies; ++body)
  {
    if (configuration.bodies[body].isEmpty())
      continue;
    near.clear();
    bodies.query(boost::geometry::index::intersects(make_tree_box<dim>(configuration.bodies[body], skin)),
                 boost::make_function_output_iterator([&near](const TreeEntry<dim> &entry)
                                                      { near.push_back(entry.second); }));
    std::sort(near.begin(), near.end());
    for (const unsigned int other : near)
      if (other > body && is_allowed(body, other))
        add_pairs(body, other, configuration);
  }
  record.note_search(positions);
}

template <int dim>
void SimplexSearch<dim>::add_pairs(unsigned int first_body, unsigned int second_body,
                                   const Configuration &configuration)
{
  const auto is_near = [&](unsigned int simplex, unsigned int body)
  {
    return configuration.bodies[body].squaredExteriorDistance(configuration.simplices[simplex]) <=
           skin * skin;
  };
  std::vector<unsigned int> second_ones;
  for (const unsigned int second : simplices_of_body[second_body])
    if (is_near(second, first_body))
      second_ones.push_back(second);
  const BoxTree<dim> tree = make_tree<dim>(configuration.simplices, second_ones);

  std::vector<unsigned int> candidates;
  for (const unsigned int first : simplices_of_body[first_body])
  {
    if (!volume.simplices[first].owned || !is_near(first, second_body))
      continue;
    candidates.clear();
    tree.query(boost::geometry::index::intersects(make_tree_box<dim>(configuration.simplices[first], skin)),
               boost::make_function_output_iterator([&candidates](const TreeEntry<dim> &entry)
                                                    { candidates.push_back(entry.second); }));
    std::sort(candidates.begin(), candidates.end());
    const SimplexShape<dim> shape = configuration.shape(volume.simplices[first]);
    for (const unsigned int second : candidates)
    {
      const SimplexShape<dim> other = configuration.shape(volume.simplices[second]);
      if (!has_separating_face(shape, other, skin) && !has_separating_face(other, shape, skin))
        pairs_.emplace_back(first, second);
    }
  }
}

template class SimplexSearch<2>;
template class SimplexSearch<3>;
} // namespace signorini::contact
