"""Docstrings for compiled code: mypyc keeps signatures of functions and classes, and no words.

It writes `text_signature` into the C tables of functions and types, where help() and inspect look
for both; the docstrings of the sources are put behind. Where another version of mypyc has no such
place, the code is compiled without them.
"""

import ast
from collections.abc import Callable, Iterable, Iterator
from inspect import cleandoc
from pathlib import Path
from typing import Any

_PLACES = {  # mypyc's functions that write a text, and the modules that have them by name
    "native_function_doc_initializer": ("emit", "emitclass", "emitmodule"),
    "native_class_doc_initializer": ("emitclass",),
}


def keep_docstrings(files: Iterable[str]) -> None:
    """Let mypyc, in this process, write the docstrings of these source files as well."""
    from importlib import import_module

    words = dict(_docstrings(files))
    for function, modules in _PLACES.items():
        for module in (import_module(f"mypyc.codegen.{name}") for name in modules):
            if hasattr(module, function):
                setattr(module, function, _with_words(getattr(module, function), words))


def _with_words(plain: Callable[[Any], str], words: dict[str, str]) -> Callable[[Any], str]:
    """Give a function that writes what `plain` does and the docstring behind it, as C strings.

    C joins literals that stand side by side.
    """
    from mypyc.codegen.cstring import c_string_initializer

    def documented(of: Any) -> str:
        signature, text = plain(of), words.get(of.fullname, "")
        if not text:
            return signature
        docstring = c_string_initializer(text.encode())
        return docstring if signature == "NULL" else f"{signature} {docstring}"

    return documented


def _docstrings(files: Iterable[str]) -> Iterator[tuple[str, str]]:
    """Give the docstrings of classes, functions and methods by their full names."""
    for file in files:
        path = Path(file)
        module = ".".join(path.with_suffix("").parts)
        yield from _inside(ast.parse(path.read_text("utf-8")), module)


def _inside(node: ast.Module | ast.ClassDef, name: str) -> Iterator[tuple[str, str]]:
    for inner in node.body:
        if isinstance(inner, ast.ClassDef | ast.FunctionDef):
            yield f"{name}.{inner.name}", cleandoc(ast.get_docstring(inner) or "")
        if isinstance(inner, ast.ClassDef):
            yield from _inside(inner, f"{name}.{inner.name}")
