"""Who may include whom: base <- mesh <- interfaces <- structure <- simulation <- main. A plugin includes base, mesh,
interfaces and its own folder. Each heavy library has its place. Exits non-zero with every line that breaks a rule."""

import os
import re
import sys
import tempfile

ROOMS = ["base", "mesh", "interfaces", "structure", "simulation"]
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')

# Third-party headers by their first folder, and the only places that may include them.
PLACES = {
    "CGAL": ["plugins/pfem_fluid/"],
    "deal.II": ["source/base/", "source/structure/", "source/simulation/", "source/main.cc", "plugins/couplers/"],
}


def rank_of(path):
    """Rank of a file of the core by its folder, of a plugin as what stands above the interfaces."""
    parts = path.split("/")
    if parts[0] == "plugins":
        return ROOMS.index("interfaces")
    if path == "source/main.cc":
        return len(ROOMS)
    room = parts[2] if parts[0] == "include" else parts[1]
    return ROOMS.index(room) if room in ROOMS else None


def violations_in(root, path):
    rank = rank_of(path)
    if rank is None:
        yield f"{path}: this folder is not one of {', '.join(ROOMS)}"
        return
    with open(os.path.join(root, path), encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            bracket, header = match.groups()
            first = header.split("/")[0]
            place = f"{path}:{number}: {line.strip()}"
            if first == "breakwater":
                room = header.split("/")[1]
                if room not in ROOMS:
                    yield f"{place}: there is no room {room}"
                elif ROOMS.index(room) > rank:
                    yield f"{place}: {room} stands above this file"
            elif bracket == '"':
                folder = os.path.dirname(path)
                own = "/".join(path.split("/")[:2])
                target = os.path.normpath(os.path.join(folder, header))
                if not target.startswith(own + "/") and target != own:
                    yield f"{place}: outside of the file's own folder"
                elif not os.path.exists(os.path.join(root, target)):
                    yield f"{place}: no such file in this folder"
            for library, allowed in PLACES.items():
                if first == library and not any(path.startswith(prefix) for prefix in allowed):
                    yield f"{place}: {library} may be included in {', '.join(allowed)} only"


def check(root):
    violations, n_files = [], 0
    for top in ["include", "source", "plugins"]:
        for folder, _, names in os.walk(os.path.join(root, top)):
            for name in sorted(names):
                if name.endswith((".h", ".cc")):
                    n_files += 1
                    violations += violations_in(root, os.path.relpath(os.path.join(folder, name), root))
    return n_files, violations


def check_the_check():
    """A small tree with one violation of each rule: each must be found."""
    files = {
        "include/breakwater/base/a.h": "#include <breakwater/mesh/b.h>\n",
        "include/breakwater/mesh/b.h": "#include <deal.II/grid/tria.h>\n#include <breakwater/base/a.h>\n",
        "plugins/one/one.cc": '#include "../two/two.h"\n#include <breakwater/simulation/s.h>\n#include "one.h"\n',
        "plugins/one/one.h": "#include <CGAL/Origin.h>\n#include <breakwater/interfaces/i.h>\n",
        "plugins/two/two.h": "#include <vector>\n",
        "source/main.cc": "#include <breakwater/simulation/s.h>\n",
    }
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            os.makedirs(os.path.join(root, os.path.dirname(path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(text)
        found = sorted(v.split(": #")[0] for v in check(root)[1])
    expected = ["include/breakwater/base/a.h:1", "include/breakwater/mesh/b.h:1", "plugins/one/one.cc:1",
                "plugins/one/one.cc:2", "plugins/one/one.h:1"]
    if found != expected:
        sys.exit(f"the check itself is wrong: it found {found}, not {expected}")


check_the_check()
n_files, violations = check(os.environ["BREAKWATER_SOURCE_DIR"])
print("\n".join(violations))
if violations or n_files < 40:
    sys.exit(f"{len(violations)} includes break the rules, in {n_files} files")
print(f"{n_files} files include only what they may")
