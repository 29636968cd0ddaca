// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/mesh_parameters.h"

#include <gtest/gtest.h>

using namespace signorini;

TEST(LargestExtent, IsThatOfTheShape)
{
  MeshParameters mesh;
  mesh.lower_corner = {-1., 2., 0.};
  mesh.upper_corner = {1., 3., 9.};
  EXPECT_DOUBLE_EQ(largest_extent(mesh, 2), 2.);
  EXPECT_DOUBLE_EQ(largest_extent(mesh, 3), 9.);
  mesh.shape = MeshParameters::Shape::ball;
  mesh.radius = 3.;
  mesh.part = MeshParameters::Part::orthant;
  EXPECT_DOUBLE_EQ(largest_extent(mesh, 3), 3.);
  mesh.part = MeshParameters::Part::half;
  EXPECT_DOUBLE_EQ(largest_extent(mesh, 2), 6.);
  mesh.shape = MeshParameters::Shape::cylinder;
  mesh.length = 7.;
  EXPECT_DOUBLE_EQ(largest_extent(mesh, 3), 7.);
}
