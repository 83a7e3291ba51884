"""Functions in children of a process whose stdin somebody holds."""

import os
import subprocess
import sys

import pytest

# Each ends by telling how a child of it ended.
_BEGIN = "import ctypes, os, sys, time; from atlas_cueing.batch.isolation import in_child\n"


def parent(code: str) -> "subprocess.Popen[str]":
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    return subprocess.Popen([sys.executable, "-c", _BEGIN + code], text=True, **pipes)  # type: ignore[call-overload,no-any-return]


def said(code: str) -> str:
    process = parent(code)
    assert process.stdin
    with process:
        assert process.stdout
        assert process.stderr
        told, wrong = process.stdout.read(), process.stderr.read()
    assert wrong == ""
    return str(told)


def ended(work: str, limit: float = 60.0) -> str:
    """Told, status, printed and late, of a child that does `work`."""
    return said(
        f"def work():\n    {work}\nend = in_child(work, {limit})\nprint(end.answer, end.status,"
        " end.printed, end.late)"
    )


def test_what_it_tells_comes_whole() -> None:
    assert ended("return b'it'") == "b'it' 0  False\n"
    assert said("print(len(in_child(lambda: bytes(3_000_000), 60.0).answer))") == "3000000\n"


def test_what_it_prints_is_kept_apart() -> None:
    assert ended("print('a', flush=True); os.write(2, b'b'); return b'it'") == "b'it' 0 a b False\n"


def test_however_it_ends_it_is_told_in_words() -> None:
    assert ended("os.write(2, b'oh'); os.abort()") == "b'' -6 oh False\n"
    assert ended("raise ZeroDivisionError('no')") == "b'' 1 ZeroDivisionError: no False\n"
    assert said("print(in_child(lambda: os._exit(3), 60.0).how())") == "ended with exit status 3\n"
    assert (
        said("print(in_child(lambda: (os.write(2, b'oh'), os.abort()), 60.0).how())")
        == "ended by SIGABRT: oh\n"
    )


def test_who_takes_too_long_is_killed() -> None:
    assert ended("time.sleep(600)", limit=0.2) == "b'' -9  True\n"


def test_a_child_is_killed_when_its_driver_ends() -> None:
    code = (
        "out = os.dup(1)\nwork = lambda: (os.write(out, b'%d\\n' % os.getpid()), time.sleep(600))\n"
    )
    process = parent(f"{code}try: in_child(work, 600.0)\nexcept EOFError as error: print(error)")
    assert process.stdin
    assert process.stdout
    child = int(process.stdout.readline())
    # closes stdin
    assert process.communicate(timeout=60) == ("the driver has ended\n", "")
    with pytest.raises(ProcessLookupError):
        os.kill(child, 0)


def test_it_has_no_stdin_and_dies_with_its_parent() -> None:
    code = "signal = ctypes.c_int(); ctypes.CDLL(None).prctl(2, ctypes.byref(signal), 0, 0, 0)"
    told = ended(f"{code}; return b'%d %r' % (signal.value, os.read(0, 1))")
    assert told == f"b\"{9 if sys.platform == 'linux' else 0} b''\" 0  False\n"
