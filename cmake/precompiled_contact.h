// SPDX-License-Identifier: LGPL-2.1-or-later
// The long headers that most sources of the contact library include.
#pragma once
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <boost/geometry/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>
