#!/usr/bin/env python3
"""Which folder may include which: docs/architecture.md draws these arrows, this list enforces them.

A name is a folder (with all below it) or one header with its source; the longest name that fits a file is its module.
'public' stands for all headers of slvm whose first comment says PUBLIC.
"""
import re

import tree

SLVM_TOP = ["slvm/value", "slvm/grid", "slvm/textures", "slvm/rays", "slvm/subsurface", "slvm/point_clouds",
            "slvm/irradiance_cache", "slvm/photon_map", "slvm/light_emitter", "slvm/renderer_services"]
ALLOWED = {
    "slvm/support": [],
    "slvm/format": ["slvm/support", "slvm/value"],
    "slvm/value": ["slvm/format"],
    "slvm/plugin": ["slvm/plugin/sdk", "slvm/format", "slvm/support", "slvm/value"],
    # What plug-ins are compiled with: nothing but each other.
    "slvm/plugin/sdk": [],
    "slvm/ir": ["slvm/format", "slvm/support", "slvm/value"],
    "slvm/wide": ["slvm/support"],
    "slvm/grid": ["slvm/format", "slvm/wide", "slvm/support", "slvm/value"],
    "slvm/textures": ["slvm/support", "slvm/value"],
    "slvm/rays": ["slvm/format", "slvm/support"],
    "slvm/subsurface": [],
    "slvm/point_clouds": ["slvm/format"],
    "slvm/irradiance_cache": [],
    "slvm/photon_map": [],
    "slvm/light_emitter": ["slvm/format", "slvm/grid"],
    "slvm/renderer_services": ["slvm/grid", "slvm/textures", "slvm/rays", "slvm/subsurface", "slvm/point_clouds",
                               "slvm/irradiance_cache", "slvm/photon_map", "slvm/format", "slvm/support", "slvm/value"],
    "slvm/kernels": ["slvm/format", "slvm/wide", "slvm/support"] + SLVM_TOP,
    "slvm/evaluator": ["slvm/ir", "slvm/format", "slvm/kernels", "slvm/wide", "slvm/support"],
    "slvm/machine": ["slvm/format", "slvm/ir", "slvm/wide", "slvm/kernels", "slvm/exec", "slvm/evaluator",
                     "slvm/plugin", "slvm/support"] + SLVM_TOP,
    "slvm/exec": ["slvm/format", "slvm/ir", "slvm/wide", "slvm/kernels", "slvm/machine", "slvm/evaluator",
                  "slvm/plugin", "slvm/support"] + SLVM_TOP,
    "slvm/tools": ["slvm", "slc", "stdlib/scattering"],
    # The module of sltest for textures takes them from the renderer.
    "slvm/tools/sltest/texture_files": ["slvm", "render/texture"],
    # Its module for scenes is the renderer.
    "slvm/tools/sltest/ray_render": ["slvm", "render", "slvm/tools/sltest/ray_scene", "stdlib/scattering"],
    "slc": ["slvm/format", "slvm/ir", "slvm/support", "slvm/value"],
    # Constant folding computes with the kernels: the tool hands them to the library.
    "slc/tools": ["slc", "slvm"],
    "render": ["public", "stdlib/scattering", "stdlib/subsurface/octree", "stdlib/subsurface/vec3", "render/hider/quad_coverage",
               "render/hider/quad_hits", "render/hider/quad_paint", "render/hider/window_weights", "render/display/quantize_row", "render/rays/hemisphere_aim",
               "render/texture/latlong", "render/texture/shadow_map", "render/texture/texture_filter", "render/texture/wide_block"],
    # Compiled once for each SIMD target.
    "render/display/quantize_row": ["render", "public", "slvm/wide/targets"],
    "render/hider/quad_hits": ["render", "public", "slvm/wide/targets"],
    "render/hider/quad_paint": ["render", "public", "slvm/wide/targets"],
    "render/hider/window_weights": ["render", "public", "slvm/wide/targets"],
    "render/rays/hemisphere_aim": ["render", "public", "slvm/wide/targets"],
    "render/texture/latlong": ["render", "public", "slvm/wide/targets"],
    "render/texture/shadow_map": ["render", "public", "slvm/wide/targets"],
    "render/texture/texture_filter": ["render", "public", "slvm/wide/targets"],
    # What slrender and the C interface share: shaders are compiled on the fly.
    "render/setup": ["render", "slc", "public"],
    "render/ri": ["render", "public"],
    "render/tools": ["render", "slc", "public", "stdlib/subsurface"],
    "stdlib": [],
    "stdlib/subsurface": ["slvm/support", "stdlib/subsurface/dipole_block"],
    "stdlib/subsurface/dipole_block": ["stdlib/subsurface", "slvm/wide/targets"],
    # What a program hangs into its services.
    "stdlib/scattering": ["public", "stdlib/subsurface"],
    "stdlib/dso": ["public", "stdlib/subsurface"], # and the headers for plug-ins
    "stdlib/tools": ["stdlib/subsurface", "slvm/support"],
    "python": ["slc", "public"],
    "docs": ["slvm", "slc/diag", "render/rib"],
    "tests": ["slc", "slvm", "render", "stdlib/subsurface", "stdlib/scattering", "tests"],
    "tests/external": ["slc", "public"],
}
# The only folders that may use these libraries.
OUTSIDE = {
    r"embree[34]/": ["render/rays", "tests/bench"],
    r"OpenImageIO/": ["render/oiio", "tests/render", "tests/bench/textures", "slvm/tools/sltest"],
    r"(?:tiffio|png)\.h": ["render/texture", "slvm/support/tiff_open", "slvm/support/tiff_pixels",
                          "tests/render/textures_test"],
    r"boost/": ["slc/preprocess"],
    r"flatbuffers/": ["slvm/format"],
    r"hwy/": ["slvm/wide", "slvm/kernels", "render/hider/quad_coverage", "render/hider/quad_hits", "render/hider/quad_paint",
             "render/hider/window_weights", "render/display/quantize_row", "render/rays/hemisphere_aim", "render/texture/latlong", "render/texture/shadow_map", "render/texture/texture_filter", "render/texture/wide_block", "stdlib/subsurface/dipole_block", "tests/bench", "tests/unit/kernels"],
    r"sleef": ["slvm/wide", "slvm/kernels", "tests/unit/kernels"],
    r"opensubdiv/": ["render/osd"],
    r"CLI/": ["slc/tools", "slvm/tools", "render/tools", "stdlib/tools"],
}
# Headers that sources of plug-ins include by their bare names.
SDK, PLUGINS = "slvm/plugin/sdk/", ("slvm/plugin/sdk", "stdlib/dso", "tests/plugins", "docs/tour")
TREES = ("slc/", "slvm/", "render/", "stdlib/", "python/", "tests/", "docs/")


def module(path):
    stem = re.sub(r"\.\w+$", "", path)
    fitting = [m for m in ALLOWED if stem == m or path.startswith(m + "/")]
    return max(fitting, key=len, default=None)


def within(path, names):
    return any(path.startswith(n + "/") or re.sub(r"\.\w+$", "", path) == n for n in names)


def is_public(path):
    return path.endswith((".def", "_generated.h")) or "PUBLIC" in tree.head_comment(tree.read(path))


def check_include(path, included, sources):
    """What is wrong with this #include of another file of ours, or None."""
    own, other = module(path), module(included)
    if SDK + included in sources and within(path, PLUGINS):
        return None
    if included not in sources:
        generated = included.endswith("_generated.h") or "embedded" in included
        return None if generated else f"includes '{included}', which is not a path from the root of a file in the tree"
    if own is None:
        return "is in no folder that .ci/check_deps.py knows"
    if own == other:
        return None
    named = re.sub(r"\.\w+$", "", included) in ALLOWED[own]
    if "/tools/" in included and not path.startswith("tests/") and not named:
        return f"includes '{included}': nothing may depend on a tools folder"
    allowed = ALLOWED[own]
    if within(included, [a for a in allowed if a != "public"]):
        return None
    if "public" in allowed and included.startswith("slvm/"):
        return None if is_public(included) else f"includes '{included}', which is not PUBLIC"
    return f"includes '{included}': {own} may only depend on {', '.join(allowed) or 'nothing'}"


def main():
    problems = []
    sources = set(tree.cpp_files(".h", ".cpp", ".inc", ".def"))
    for path in sorted(s for s in sources if s.startswith(TREES)):
        text = tree.read(path)
        for included in re.findall(r'^\s*#\s*include\s+"([^"]+)"', text, re.M):
            problem = check_include(path, included, sources)
            if problem:
                problems.append(f"{path} {problem}")
        for included in re.findall(r"^\s*#\s*include\s+<([^>]+)>", text, re.M):
            for pattern, folders in OUTSIDE.items():
                if re.match(pattern, included) and not within(path, folders):
                    problems.append(f"{path} includes <{included}>: only {', '.join(folders)} may")
    tree.finish(problems)


main()
