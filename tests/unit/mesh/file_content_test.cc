// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_text.h"

#include "signorini/mesh/file_content.h"

#include <zlib.h>

using namespace signorini;
using namespace signorini::test;

TEST(FileContent, AbaqusFilesMayBePacked)
{
  EXPECT_EQ(ending_of("a/b.INP"), ".inp");
  EXPECT_EQ(ending_of("a/b.inp.gz"), ".inp");
  EXPECT_EQ(ending_of("a/B.INP.GZ"), ".inp");
  EXPECT_EQ(ending_of("a/b.msh.gz"), ".gz");
}

TEST(FileContent, PackedAndUnpackedNamesStandForEachOther)
{
  using Names = std::vector<std::string>;
  EXPECT_EQ(possible_names("a/b.inp"), (Names{"a/b.inp", "a/b.inp.gz"}));
  EXPECT_EQ(possible_names("a/b.inp.gz"), (Names{"a/b.inp.gz", "a/b.inp"}));
  EXPECT_EQ(possible_names("a/b.msh"), (Names{"a/b.msh"}));
  EXPECT_EQ(possible_names("a/b.step"), (Names{"a/b.step"}));
}

TEST(FileContent, IsUnpacked)
{
  const std::string text = "*NODE\n1, 0, 0, 0\n";
  const TemporaryFile file(".inp.gz", "");
  const gzFile packed = gzopen(file.path.c_str(), "wb");
  ASSERT_TRUE(packed);
  EXPECT_EQ(gzwrite(packed, text.data(), text.size()), static_cast<int>(text.size()));
  EXPECT_EQ(gzclose(packed), Z_OK);
  EXPECT_EQ(read_content(file.path), text);
  EXPECT_EQ(read_content(TemporaryFile(".inp", text).path), text);
}
