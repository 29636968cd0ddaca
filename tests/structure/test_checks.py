#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The structure checks find what they are there to find: each is run on a small tree with one seeded violation."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import files
import layers

HERE = pathlib.Path(__file__).resolve().parent
LICENCE = "SPDX-License-Identifier: " + "LGPL-2.1-or-later"
SOUND = {
    "doc/layers.txt": "# order\nbase\ncontact/geometry\ncontact/search\nsolvers\n",
    "include/signorini/base/vector.h": f"// {LICENCE}\n#include <vector>\n",
    "include/signorini/contact/geometry/depth.h": f'// {LICENCE}\n#include "signorini/base/vector.h"\n',
    "include/signorini/contact/search/tree.h": f'// {LICENCE}\n#include "signorini/contact/geometry/depth.h"\n',
    "source/contact/search/tree.cc": f'// {LICENCE}\n#include "signorini/contact/search/tree.h"\n',
    "source/contact/search/tree_wide.cc": f'// {LICENCE}\n#include "signorini/contact/search/tree.h"\n',
    "source/main.cc": f'// {LICENCE}\n#include "signorini/contact/search/tree.h"\n',
    "scripts/setup": f"#!/usr/bin/env bash\n# {LICENCE}\ntrue\n",
    "scripts/report": f"#!/usr/bin/python3\n# {LICENCE}\nprint()\n",
    "parameter_files/scene.prm": "# A scene.\nset Degree = 1\n",
    "doc/changes/contact.md": "New: contact.\n",
}


class StructureTest(unittest.TestCase):
    def tree_with(self, changes):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        root = pathlib.Path(folder.name).resolve()
        for name, text in {**SOUND, **changes}.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
            path.chmod(0o755 if text.startswith("#!") else 0o644)
        return root

    def finds(self, check, saying, changes):
        errors = check(self.tree_with(changes))
        self.assertEqual(len(errors), 1, errors)
        self.assertIn(saying, errors[0])

    def including(self, *headers):
        return f"// {LICENCE}\n" + "".join(f'#include "{header}"\n' for header in headers)

    def test_a_sound_tree_passes(self):
        root = self.tree_with({})
        self.assertEqual(layers.check(root), [])
        self.assertEqual(files.check(root), [])

    def test_layers(self):
        for saying, changes in (
                ("stands below", {"source/base/vector.cc": self.including("signorini/contact/search/tree.h")}),
                ("stands below", {"include/signorini/contact/geometry/point.h":
                                  self.including("signorini/contact/search/tree.h")}),
                ("not listed", {"include/signorini/extras/a.h": self.including()}),
                ("not listed", {"include/signorini/contact/loose.h": self.including()}),
                ("not listed", {"include/signorini/loose.h": self.including()}),
                ("no include/signorini/solvers/newton.h", {"source/solvers/newton.cc": self.including()}),
                ("holds .cc files only", {"source/base/hidden.h": self.including()}),
                ("does not exist", {"include/signorini/base/b.h": self.including("signorini/base/none.h")}),
                ("own headers", {"include/signorini/base/b.h": self.including("vector.h")}),
                ("own headers", {"include/signorini/base/b.h":
                                 f"// {LICENCE}\n#include <signorini/base/vector.h>\n"}),
                ("cycle", {"include/signorini/base/b.h": self.including("signorini/base/c.h"),
                           "include/signorini/base/c.h": self.including("signorini/base/b.h")})):
            with self.subTest(saying=saying, changes=changes):
                self.finds(layers.check, saying, changes)

    def test_files(self):
        for saying, changes in (
                ("401 lines", {"source/solvers/long.cc": f"// {LICENCE}\n" + "\n" * 400}),
                ("61 lines", {"source/main.cc": f"// {LICENCE}\n" + "\n" * 60}),
                ("needs one line", {"include/signorini/base/b.h": "#pragma once\n"}),
                ("needs one line", {"include/signorini/base/b.h": f"// {LICENCE}\n// {LICENCE}\n"}),
                ("needs one line", {"CMakeLists.txt": "project(x)\n"}),
                ("needs one line", {"scripts/other": "#!/usr/bin/env bash\ntrue\n"}),
                ("bash -n", {"scripts/setup": f"#!/usr/bin/env bash\n# {LICENCE}\nif true\n"}),
                ("scripts/report", {"scripts/report": f"#!/usr/bin/python3\n# {LICENCE}\nprint(\n"}),
                ("must start with a comment", {"parameter_files/scene.prm": "set Degree = 1\n"}),
                ("change note", {"doc/changes/contact.md": "contact\n"})):
            with self.subTest(saying=saying, changes=changes):
                self.finds(files.check, saying, changes)

    def test_scripts_must_be_executable(self):
        root = self.tree_with({})
        (root / "scripts/setup").chmod(0o644)
        self.assertIn("may not be executed", files.check(root)[0])

    def test_the_programs_return_failure(self):
        sound = self.tree_with({})
        broken = self.tree_with({"include/signorini/base/b.h": '#include "signorini/contact/search/tree.h"\n'})
        for program in ("layers.py", "files.py"):
            for root, code in ((sound, 0), (broken, 1)):
                done = subprocess.run([sys.executable, str(HERE / program), str(root)], capture_output=True, check=False)
                self.assertEqual(done.returncode, code, program)

    def test_manual(self):
        for stored, printed, code in (("a\n", "a\n", 0), ("a\n", "b\n", 1), ("", "", 1)):
            root = self.tree_with({"doc/parameters.md": stored,
                                   "program": f"#!/bin/sh\n# {LICENCE}\nprintf '%s' '{printed}'\n"})
            done = subprocess.run([sys.executable, str(HERE / "manual.py"), str(root), str(root / "program")],
                                  capture_output=True, check=False)
            self.assertEqual(done.returncode, code, (stored, printed))


if __name__ == "__main__":
    unittest.main()
