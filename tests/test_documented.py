"""Words of the sources in the C code that mypyc makes of them."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from documented import add_docstrings
from installed import PACKAGE

SOURCE = '''"""Turns \\"all\\"."""
def turn(q):
    """Turn \\"q\\" by 3°."""

class Sphere:
    """A sphere.

    Second line?"""

    def turn(self):
        """Turn it."""

    def bare(self): ...
'''
CODE = r"""
    {"turn", (PyCFunction)CPyPy_wheels___sphere___turn, METH_FASTCALL | METH_KEYWORDS, PyDoc_STR("turn(q)\n--\n\n") /* docstring */},
    {"turn",
     (PyCFunction)CPyPy_wheels___sphere___Sphere___turn,
     METH_FASTCALL | METH_KEYWORDS, PyDoc_STR("turn($self)\n--\n\n")},
    {"bare",
     (PyCFunction)CPyPy_wheels___sphere___Sphere___bare,
     METH_FASTCALL | METH_KEYWORDS, PyDoc_STR(NULL)},
    .tp_basicsize = sizeof(package___wheels___sphere___SphereObject),
    .tp_flags = Py_TPFLAGS_DEFAULT,
    .tp_doc = PyDoc_STR("Sphere()\n--\n\n"),
};
    PyModuleDef_HEAD_INIT,
    "package.wheels.sphere",
    NULL, /* docstring */
    0,
"""  # noqa: E501 - as mypyc writes it


def test_words_stand_behind_their_signatures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    source, code = Path("package/wheels/sphere.py"), Path("__native_package___wheels___sphere.c")
    source.parent.mkdir(parents=True)
    source.write_text(SOURCE)
    code.write_text(CODE)
    other = Path("init.c")
    other.write_text(CODE)
    add_docstrings([str(code), str(other)], [str(source)])
    assert other.read_text() == CODE
    lines = code.read_text().splitlines()
    written = [line.split("PyDoc_STR(")[1].rsplit(")", 1)[0] for line in lines if "Doc_" in line]
    literals = [f"b{text}".replace(' "', ' b"') for text in written if text != "NULL"]
    texts = [ast.literal_eval(literal) for literal in literals]
    assert [text.decode() for text in texts] == [
        'turn(q)\n--\n\nTurn "q" by 3°.',
        "turn($self)\n--\n\nTurn it.",
        "Sphere()\n--\n\nA sphere.\n\nSecond line?",
        'Turns "all".',
    ]
    assert len(written) == 5
    assert written[2] == "NULL"


def docstrings() -> Iterator[tuple[str, str]]:
    """Every docstring of the package, with where it stands."""
    for file in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
                name = f"{file.relative_to(PACKAGE)}: {getattr(node, 'name', '')}"
                yield name, ast.get_docstring(node) or "(none is needed)"


def test_no_docstring_is_a_place_for_one() -> None:
    """A linter takes "TO WRITE." for a sentence."""
    for place, text in docstrings():
        begins = text.split("\n")[0]
        assert not re.match(r"(to write|todo|fixme|set up\.|of |those )", begins.lower()), place
        assert begins.startswith("`") or len(begins.split()) > 1, place
