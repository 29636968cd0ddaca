// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/base/collective_error.h"
#include "signorini/base/exceptions.h"

#include <gtest/gtest.h>

using namespace signorini;

TEST(ThrowTogether, KeepsTheWholeComplaint)
{
  const InputError original(
      Complaint("what").at("where").found("value").expected("range").did_you_mean("name").advise("step"));
  std::string message;
  try
  {
    throw_together(MPI_COMM_WORLD, [&]() { throw original; });
  }
  catch (const InputError &error)
  {
    message = error.what();
  }
  EXPECT_EQ(message, original.what());
}

TEST(ThrowTogether, KeepsTheKind)
{
  const auto fail_with = [](const auto &error)
  { return [error]() { throw_together(MPI_COMM_WORLD, [&error]() { throw error; }); }; };
  EXPECT_THROW(fail_with(InputError("input"))(), InputError);
  EXPECT_THROW(fail_with(FileError("file"))(), FileError);
  EXPECT_THROW(fail_with(NumericalError("number"))(), NumericalError);
}

TEST(ThrowTogether, IsSilentWithoutAFault)
{
  bool is_called = false;
  EXPECT_NO_THROW(throw_together(MPI_COMM_WORLD, [&]() { is_called = true; }));
  EXPECT_TRUE(is_called);
}
