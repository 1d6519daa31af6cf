#!/usr/bin/env python3
"""Writes docs/api.md: its two examples are those of examples/, with what they print. docs/make_api.py"""

import pathlib
import subprocess
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
BUILD = ROOT / "build/release/bin"
TEXT = """# The C++ API

Written by `docs/make_api.py`; do not edit.

Public headers are `<module>/include/blum/<module>/`; every function there says what it needs, what it returns,
its units and its errors. Bad input gives `Result<T>` (a value, or an `Error` with a stable code); a broken
invariant throws `BrokenInvariant`, a defect of Blum. Nothing prints or exits.

| library | headers to begin with | what for |
|---|---|---|
| `blum::kernel` | `mesh.hpp`, `solid.hpp`, `validate.hpp`, `site_tree.hpp` | read a mesh; validate it exactly; distances |
| `blum::gpu` | `field.hpp`, `field_io.hpp` | distance fields on grids |
| `blum::medial` | `medial_axis.hpp`, `parts.hpp`, `simplify.hpp`, `graph.hpp`, `io.hpp` | the axis, its sheets, pruning, files |
| `blum::placement` | `placement.hpp`, `feet.hpp`, `reconstruction.hpp`, `smooth.hpp` | its points on the exact axis, meshes, the bound; feet |
| `blum::verify` | `verify.hpp` | certificates |
| `blum::thickness` | `thickness.hpp`, `midsurface.hpp`, `touching_ball.hpp` | walls |
| `blum::show` | `scene.hpp`, `page.hpp`, `render.hpp`, `chart.hpp` | read results back; pages and pictures |

After `cmake --install build/release --prefix DIR`:

```cmake
find_package(blum 0.1 REQUIRED COMPONENTS medial)
target_link_libraries(mine PRIVATE blum::medial)
```
"""
EXAMPLES = [
    ("From a mesh to its axis", "mesh_to_axis", [],
     "A mesh in memory, its solid, its axis, and the files of `blum medial`."),
    ("Walking over sheets, seams and junctions", "walk_sheets", [],
     "Which faces a sheet lies between, how large it is, how far from the boundary."),
]


def main():
    text = TEXT
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([BUILD / "blum", "make", "plate", "1", "6", "-o", "plate.off"], cwd=folder,
                       check=True, capture_output=True)
        for title, name, arguments, purpose in EXAMPLES:
            done = subprocess.run([BUILD / f"example_{name}", *arguments], cwd=folder, check=True,
                                  capture_output=True, text=True)
            code = (ROOT / "examples" / f"{name}.cpp").read_text().rstrip()
            text += f"\n## {title}\n\n{purpose} `examples/{name}.cpp`:\n\n```cpp\n{code}\n```\n\n"
            text += f"It prints\n\n```\n{done.stdout.rstrip()}\n```\n"
    (HERE / "api.md").write_text(text)


if __name__ == "__main__":
    main()
