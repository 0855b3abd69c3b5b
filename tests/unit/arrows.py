#!/usr/bin/env python3
"""Checks that includes point one way: base <- physics <- scene <- render -> vk, image; scene <- quantity; server and
cli on top.

arrows.py SRC exit 1 naming every forbidden #include in SRC; the checks are first tested on planted errors
"""

import collections
import pathlib
import re
import sys
import tempfile

# The modules that each module may include besides itself. The server uses no Vulkan type, so it does not include vk.
# Add a row here for a new module.
MODULES = {
    "base": set(),
    "document": {"base"},
    "physics": {"base"},
    "scene": {"base", "document", "physics"},
    "quantity": {"base", "document", "physics", "scene"},  # uses scene's field table and its writer
    "image": {"base"},
    # uses scene's field table and its writer, as quantity does
    "orbit": {"base", "document", "physics", "scene", "image"},
    "observe": {"base"},
    "integral": {
        "base",
        "document",
        "observe",
        "physics",
        "scene",
        "image",
        "render",
    },  # uses plans and frames of render
    # uses scene's field table and its writer, as quantity does
    "playground": {"base", "document", "physics", "scene", "image"},
    "vk": {"base"},
    "render": {"base", "document", "physics", "scene", "image", "vk"},
    "job": {"base", "document", "scene", "playground", "render"},  # uses the frames that render makes
    "server": {
        "base",
        "document",
        "physics",
        "scene",
        "quantity",
        "orbit",
        "observe",
        "integral",
        "playground",
        "image",
        "render",
        "job",
    },
    "cli": {
        "base",
        "document",
        "physics",
        "scene",
        "quantity",
        "orbit",
        "observe",
        "integral",
        "playground",
        "image",
        "vk",
        "render",
        "job",
        "server",
    },
    "main.c": {"base", "cli", "vk"},  # vk is included because it may restart the program
}
# Inside a large module, a folder may include those listed before it. Files of the module that are in no folder may
# include all folders.
FOLDERS = {
    "render": [
        "view",
        "accuracy",
        "sky",
        "emit",
        "plan",
        "device",
        "rays",
        "lens",
        "frame",
        "output",
        "explain",
        "live",
        "selftest",
    ],
    "server": ["http", "asset", "render", "session", "lesson", "playground", "job", "openapi", "answers"],
}
# Inside physics, a folder may include itself and the listed ones; every file is in a folder.
ROOMS = {
    "physics": {
        "math": set(),
        "spacetime": {"math"},
        "null": {"math", "spacetime"},
        "orbit": {"math", "spacetime"},
        "disk": {"math", "spacetime", "null"},
        "waves": {"math", "spacetime"},
    }
}
# In these modules includes must not form a circle. A header and its source count as one file, with the includes of
# both.
NO_CIRCLES = {
    "base",
    "document",
    "physics",
    "scene",
    "quantity",
    "orbit",
    "observe",
    "integral",
    "playground",
    "vk",
    "job",
    "cli",
}
# In these modules calls count as includes, because one header may declare what several files define.
CALLS = {"physics", "vk"}
# Largest number of files that may share a name.
SAME_NAME = 5
# Headers of other projects, and who may include them.
FOREIGN = {
    "vulkan/": {"vk"},
    "cjson/": {"document", "scene", "orbit", "integral", "playground", "render", "job", "server", "cli"},
    "microhttpd.h": {"server"},
    "png.h": {"image"},
    "libdeflate.h": {"image"},
    "isa-l/": {"image"},
    "zlib.h": {"image"},
    "nettle/": {"scene", "playground", "server"},
    "argp.h": {"cli"},
    "sixel.h": {"cli"},
}
# Headers made from shaders/. They can be included in no other way.
SHADERS = re.compile(r"^(\w+\.spv\.h|(interface|emitters|faces|layers|lens|spec)\.h)$")
DEFINED = re.compile(r"^(?!static\b)[A-Za-z_][\w *]*?\b(kd_\w+)\([^;{}]*\)\s*\{", re.M)
CALLED = re.compile(r"\bkd_\w+(?=\()")
INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)', re.M)


def rank(module, parts):
    """Position of a file or header among the folders of its module. A file may include files of lower positions."""
    order = FOLDERS[module]
    return len(order) if len(parts) < 3 else order.index(parts[1]) if parts[1] in order else -1


def room_knows(module, mine, its):
    """True if a file in the folder `mine` of a module may include a file in the folder `its`. None stands for a file
    outside the folders."""
    rooms = ROOMS[module]
    return mine in rooms and its in rooms and (mine == its or its in rooms[mine])


def folder(parts):
    return parts[1] if len(parts) > 2 else None


def wrong(src):
    """Sentences, one for each forbidden include."""
    for path in sorted(src.rglob("*.[ch]")):
        where = path.relative_to(src)
        module = where.parts[0]
        if module not in MODULES:
            yield f"{where}: {module} is no module that arrows.py knows"
            continue
        for own, foreign in INCLUDE.findall(path.read_text(encoding="utf-8")):
            # also finds <scene/scene.h> and "vulkan/vulkan.h"
            header = own or foreign
            other = header.split("/")[0]
            for prefix, allowed in FOREIGN.items():
                if header.startswith(prefix) and module not in allowed:
                    yield f"{where}: {module} must not know {header}"
            if other in MODULES and "/" in header:
                if other != module and other not in MODULES[module]:
                    yield f"{where}: {module} -> {other} ({header})"
                if other == module and module in FOLDERS:
                    mine, its = rank(module, where.parts), rank(module, header.split("/"))
                    if mine < 0 or its > mine:
                        yield f"{where}: {where.parts[1]} must not know {header}"
                if other == module and module in ROOMS:
                    if not room_knows(module, folder(where.parts), folder(header.split("/"))):
                        yield f"{where}: {where.parts[1]} must not know {header}"
            elif own and SHADERS.match(own):
                if module != "render":
                    yield f"{where}: {module} must not know the kernels ({header})"
            elif own and not any(own.startswith(prefix) for prefix in FOREIGN):
                yield f'{where}: "{own}" does not name its module'


def circle(known):
    """A circle of includes: each file includes the next, and the last includes the first. [] if there is no circle."""
    done, way = set(), []

    def follow(file):
        if file in way:
            return way[way.index(file) :]
        if file in done:
            return []
        way.append(file)
        found = next(filter(None, map(follow, sorted(known.get(file, ())))), [])
        way.pop()
        done.add(file)
        return found

    return next(filter(None, map(follow, sorted(known))), [])


def circles(src):
    """One sentence for each module whose includes form a forbidden circle."""
    for module in sorted(NO_CIRCLES):
        texts = {
            path.relative_to(src): path.read_text(encoding="utf-8") for path in sorted((src / module).rglob("*.[ch]"))
        }
        known, homes = {}, {}
        for path, text in texts.items():
            if module in CALLS and path.suffix == ".c":
                homes.update((name, str(path.with_suffix(""))) for name in DEFINED.findall(text))
        for path, text in texts.items():
            file = str(path.with_suffix(""))
            others = {own.rpartition(".")[0] for own, _ in INCLUDE.findall(text)}
            if path.suffix == ".c":
                others |= {homes[name] for name in CALLED.findall(text) if name in homes}
            known.setdefault(file, set()).update(other for other in others - {file} if other.startswith(module + "/"))
        if found := circle(known):
            yield f"{module}: a circle: {' -> '.join([*found, found[0]])}"


def crowds(src):
    """One sentence for each name that too many files share."""
    names = collections.Counter(path.name for path in src.rglob("*.[ch]"))
    for name, count in sorted(names.items()):
        if count > SAME_NAME:
            yield f"{name}: {count} files have this name; it must be {SAME_NAME} at most"


def self_test():
    """Each kind of wrong include is found, and a right one is not reported."""
    faults = {
        "base/a.c": '#include "physics/spacetime/kerr.h"',
        "physics/a.h": "#include <vulkan/vulkan.h>",
        "physics/b.c": "# include <cjson/cJSON.h>",
        "scene/a.c": '#include "render/plan/plan.h"',
        "vk/a.c": '#include "scene/scene.h"',
        "vk/b.c": "#include <microhttpd.h>",
        "image/a.c": '#include "scene/scene.h"',
        "server/a.c": '#include "vk/vk.h"',
        "server/b.c": "#include <vk/vk.h>",
        "render/a.c": '#include "server/server.h"',
        "server/c.c": '#include "post.spv.h"',
        "render/b.c": '#include "plan.h"',
        "quantity/a.c": '#include "render/plan/plan.h"',
        "scene/b.c": '#include "quantity/quantity.h"',
        "news/a.c": "",
        "render/view/a.c": '#include "render/plan/plan.h"',
        "render/rays/a.h": '#include "render/render.h"',
        "server/http/a.c": '#include "server/job/jobs.h"',
        "render/new/a.c": '#include "render/view/camera.h"',
        "physics/math/a.c": '#include "physics/spacetime/kerr.h"',
        "physics/orbit/a.c": '#include "physics/null/critical.h"',
        "physics/c.c": '#include "physics/math/root.h"',
        "physics/new/a.c": '#include "physics/math/root.h"',
    }
    ring = {
        "job/a.h": '#include "job/b.h"',
        "job/b.c": '#include "job/c.h"',
        "job/c.c": '#include "job/a.h"',
        "job/d.c": '#include "job/a.h"',
    }
    calls = {
        "vk/all.h": "void kd_up(void);\nvoid kd_down(void);",
        "vk/down.c": '#include "vk/all.h"\nvoid kd_down(void)\n{\n    kd_up();\n}',
        "vk/up.c": '#include "vk/all.h"\nvoid kd_up(void)\n{\n    kd_down();\n}',
    }
    right = {
        "render/c.c": '#include "vk/vk.h"\n#include "post.spv.h"\n#include <math.h>',
        "server/d.c": '#include "render/plan/plan.h"',
        "physics/disk/a.c": '#include "physics/null/critical.h"\n#include "physics/disk/a.h"',
    }
    with tempfile.TemporaryDirectory() as folder:
        src = pathlib.Path(folder)
        for name, text in {**faults, **ring, **calls, **right}.items():
            (src / name).parent.mkdir(exist_ok=True)
            (src / name).write_text(text + "\n")
        found = list(wrong(src))
        missed = [name for name in faults if not any(line.startswith(name + ":") for line in found)]
        if list(circles(src)) != [
            "job: a circle: job/a -> job/b -> job/c -> job/a",
            "vk: a circle: vk/down -> vk/up -> vk/down",
        ]:
            missed.append("a circle")
        if not any(line.startswith("a.c: ") for line in crowds(src)):
            missed.append("a crowd")
        false = [line for line in found if line.split(":")[0] in right]
    for line in missed:
        print("not found:", line)
    for line in false:
        print("wrongly found:", line)
    return bool(missed or false)


def main():
    if self_test():
        return True
    src = pathlib.Path(sys.argv[1])
    found = [*wrong(src), *circles(src), *crowds(src)]
    for line in found:
        print(line)
    return bool(found) or not any(src.rglob("*.c"))


if __name__ == "__main__":
    sys.exit(main())
