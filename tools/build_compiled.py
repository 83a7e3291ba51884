"""Compiles the modules that run every tick by mypyc (https://mypyc.readthedocs.io).

A module that is to be compiled says so itself, in a line that reads exactly as MARK.
"""

import os
import shlex
import sys
import sysconfig
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory
from typing import Any

from documented import add_docstrings
from setuptools import Extension
from setuptools.command.build_ext import build_ext
from setuptools.errors import CCompilerError

PACKAGE = Path("atlas_cueing")
OBSTACLE = PACKAGE / "not_compiled.txt"  # in a wheel that is not: why
MARK = "# mypyc: runs every tick"
# the small functions of one module become part of those that call them in another, which takes a
# sixth off the pipeline
AS_ONE = ["-flto=auto", "-O2", "-fvisibility=hidden", "-fno-semantic-interposition"]


def compiled_modules() -> list[str]:
    """Give the files of the modules that are to be compiled."""
    every = sorted(PACKAGE.rglob("*.py"))
    return [str(path) for path in every if MARK in path.read_text("utf-8").splitlines()]


def obstacle() -> str:
    """Tell in a few words why there is no use in trying to compile; "" when there may be."""
    if sys.implementation.name != "cpython":
        return "mypyc compiles for CPython only"
    command = os.environ.get("CC") or sysconfig.get_config_var("CC") or "cc"
    compiler = shlex.split(command)[0]
    if which(compiler) is None:
        return f"no C compiler ({compiler} not found)"
    if not any(Path(folder, "Python.h").exists() for folder in _header_folders()):
        return "no Python headers (Python.h; Debian has them in python3-dev)"
    return ""


def extensions() -> list[Extension]:
    """Give the compiled modules as extensions of C: mypyc translates them now."""
    from mypyc.build import mypycify

    # Types are checked elsewhere, with everything installed; here little is.
    options = ["--config-file=", "--ignore-missing-imports", "--follow-imports=silent"]
    # A file for each module, so that the processors share the work.
    arguments = [*options, *compiled_modules()]
    found = mypycify(arguments, opt_level="2", debug_level="0", multi_file=True)
    written = (file for extension in found for file in extension.sources)
    add_docstrings(written, compiled_modules())
    for extension in found:
        kept = [flag for flag in extension.extra_compile_args if flag != "-Werror"]
        extension.extra_compile_args = [*kept, "-ffp-contract=off"]  # fused operations: other bits
    return found


class ParallelBuild(build_ext):  # type: ignore[misc] # without types
    """Runs the C compiler once for each processor; setuptools does so for extensions only."""

    def build_extensions(self) -> None:
        """Compile and link all of them."""
        self.parallel = os.cpu_count()
        if self._links_as_one():
            for extension in self.extensions:
                extension.extra_compile_args += AS_ONE
                extension.extra_link_args += AS_ONE
        one_by_one = self.compiler.compile

        def compile_all(sources: list[str], **how: Any) -> list[str]:
            with ThreadPoolExecutor(self.parallel) as pool:
                found = pool.map(lambda source: one_by_one([source], **how), sources)
                return [file for files in found for file in files]

        self.compiler.compile = compile_all
        super().build_extensions()

    def _links_as_one(self) -> bool:
        """Try AS_ONE on a file of one function: clang may lack the linker for it."""
        with TemporaryDirectory() as name:
            source = Path(name, "one.c")
            source.write_text("int one(void) { return 1; }\n", "utf-8")
            try:
                made = self.compiler.compile([str(source)], name, extra_preargs=AS_ONE)
                self.compiler.link_shared_object(made, f"{name}/one.so", extra_preargs=AS_ONE)
            except CCompilerError:
                return False
        return True


def _header_folders() -> list[str]:
    return [sysconfig.get_path("include"), sysconfig.get_path("platinclude")]
