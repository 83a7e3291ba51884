"""Docstrings for compiled code: mypyc keeps signatures of functions and classes, and no words.

It writes them into tables of the C files, where help() and inspect look for both; the docstrings
of the sources are put behind, and those of modules in place of none. What another version of mypyc
writes in another way stays as it is.
"""

import ast
import re
from collections.abc import Iterable, Iterator
from inspect import cleandoc
from pathlib import Path

_TEXT = r'PyDoc_STR\((?P<text>"(?:[^"\\]|\\.)*"|NULL)\)'
_FUNCTION = re.compile(rf"(?P<head>CPyPy_(?P<name>\w+),\s*METH_[^\"\n]*){_TEXT}")
_MODULE = re.compile(r'(?P<head>PyModuleDef_HEAD_INIT,\s*"[\w.]+",\s*)NULL, /\* docstring \*/')
_CLASS = re.compile(rf"(?P<head>sizeof\((?P<name>\w+)Object\),[^;]*?\.tp_doc = ){_TEXT}")


def add_docstrings(c_files: Iterable[str], modules: Iterable[str]) -> None:
    """Put the docstrings of these source files into the C files that mypyc made of them."""
    words = {"___".join(Path(file).with_suffix("").parts): file for file in modules}
    for file in map(Path, c_files):
        module = file.stem.removeprefix("__native_")
        if module in words:
            source = Path(words[module]).read_text("utf-8")
            file.write_text(_documented(file.read_text("utf-8"), module, source), "utf-8")


def _documented(code: str, module: str, source: str) -> str:
    """The C code of a module with the docstrings of its source."""
    tree = ast.parse(source)
    words = dict(_inside(tree))
    parts = module.split("___")
    # a function has the shortest end of the module's name that is not another's as well
    short = [f"{'___'.join(parts[start:])}___" for start in range(len(parts))]

    def with_words(found: re.Match[str]) -> str:
        name = found["name"]
        known = (words.get(name.removeprefix(s)) for s in short if name.startswith(s))
        text = next((word for word in known if word), "")
        written = "" if found["text"] == "NULL" else found["text"]
        return f"{found['head']}PyDoc_STR({written} {_literal(text)})" if text else found[0]

    code = _CLASS.sub(with_words, _FUNCTION.sub(with_words, code))
    of_module = f"PyDoc_STR({_literal(ast.get_docstring(tree, clean=False) or '')}),"
    return _MODULE.sub(lambda found: found["head"] + of_module, code)


def _inside(node: ast.Module | ast.ClassDef, outer: str = "") -> Iterator[tuple[str, str]]:
    """Docstrings of classes, functions and methods by their names, as C has them."""
    for inner in node.body:
        if isinstance(inner, ast.ClassDef | ast.FunctionDef):
            yield f"{outer}{inner.name}", cleandoc(ast.get_docstring(inner) or "")
        if isinstance(inner, ast.ClassDef):
            yield from _inside(inner, f"{outer}{inner.name}___")


def _literal(text: str) -> str:
    """A string of C; two of them side by side are one."""
    letters = (
        chr(byte) if 32 <= byte < 127 and chr(byte) not in '"\\?' else f"\\{byte:03o}"
        for byte in text.encode()
    )
    return f'"{"".join(letters)}"'
