// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/search/interior_search.h"

#include "../laws/box_surface.h"

#include <gtest/gtest.h>

using namespace signorini;
using namespace signorini::contact;
using namespace signorini::test;

namespace
{
bool every_body(unsigned int)
{
  return true;
}

template <int dim>
BoxBody<dim> make_box(const SpatialVector<dim> &corner, double size, const FacetElement<dim> &element)
{
  BoxBody<dim> box;
  box.type = element.type;
  box.corner = corner;
  box.size = SpatialVector<dim>::Constant(size);
  box.degree = element.degree;
  box.n_faces = 3;
  return box;
}

/// How deep a point lies in a box; negative outside.
template <int dim>
double depth_in_box(const BoxBody<dim> &box, const SpatialVector<dim> &x)
{
  return std::min((x - box.corner).minCoeff(), (box.corner + box.size - x).minCoeff());
}

/// Points in and around two boxes, one of which holds the other.
template <int dim>
void compare_with_boxes(const FacetElement<dim> &outer_element, const FacetElement<dim> &inner_element)
{
  const std::vector<BoxBody<dim>> boxes{make_box<dim>(SpatialVector<dim>::Zero(), 2., outer_element),
                                        make_box<dim>(SpatialVector<dim>::Constant(.5), .7, inner_element)};
  BoxSurfaceBuilder<dim> builder;
  for (const BoxBody<dim> &box : boxes)
    builder.add(box);
  const InteriorSearch<dim> search(builder.surface, builder.surface.reference_positions);

  RandomVectors<dim> random(7);
  for (unsigned int i = 0; i < 300; ++i)
  {
    const SpatialVector<dim> x = SpatialVector<dim>::Constant(1.) + random.vector(1.3);
    const double outer = depth_in_box(boxes[0], x), inner = depth_in_box(boxes[1], x);
    const auto deepest = search.find_deepest(x, every_body);
    ASSERT_EQ(deepest.has_value(), outer > 0.);
    if (deepest)
    {
      EXPECT_NEAR(deepest->depth, std::max(outer, inner), 1e-12);
      EXPECT_EQ(deepest->body, inner > outer ? 1u : 0u);
      EXPECT_EQ(builder.surface.facets[deepest->facet].body, deepest->body);
    }
    const auto second = search.find_deepest(x, [](unsigned int body) { return body == 1; });
    ASSERT_EQ(second.has_value(), inner > 0.);
    if (second)
    {
      EXPECT_NEAR(second->depth, inner, 1e-12);
    }
  }
}

TEST(InteriorSearch, FindsDepthsInBoxes)
{
  for (const unsigned int degree : {1u, 2u})
  {
    compare_with_boxes<2>({degree}, {degree});
    compare_with_boxes<3>({degree}, {degree});
    compare_with_boxes<3>({degree, FacetType::triangle}, {degree});
    compare_with_boxes<3>({degree}, {degree, FacetType::triangle});
  }
}

TEST(InteriorSearch, TakesNoPointOfTheSurfaceForAnInnerOne)
{
  for (const FacetType type : {FacetType::tensor_product, FacetType::triangle})
  {
    BoxSurfaceBuilder<3> builder;
    builder.add(make_box<3>(SpatialVector<3>::Zero(), 1., {1, type}));
    const auto &nodes = builder.surface.reference_positions;
    const InteriorSearch<3> search(builder.surface, nodes);
    for (const SpatialVector<3> &node : nodes)
    {
      const auto found = search.find_deepest(node, every_body);
      EXPECT_LT(found ? found->depth : 0., 1e-14);
    }
  }
}
} // namespace
