"""Mutates packages at random, like a broken disk, an editor, a merge or an attacker would."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from random import Random

Files = dict[str, bytes]
Mutation = Callable[[bytes, Random], bytes]

MOST_BYTES = 400_000
"""Of a file; most kinds of files are not read beyond."""
_COUNTS = (2, 3, 10, 60, 300, 1100, 4000, 20_000)
_PAIRS = (b"()", b"[]", b"{}", b"<>", b"''", b'""', b"\n ", b"  ")
_WORDS = (
    b"\0",
    b"\r",
    b"\r\n",
    b"\t",
    b"\x0c",
    b"\x1b[2J",
    b"\xff\xfe",
    b"\xef\xbb\xbf",
    b"\xc2\x85",
    b"\xe2\x80\xa8",
    b"\xed\xa0\x80",
    b"\\",
    b"\\\n",
    b'"""',
    b"'''",
    b"#",
    b"# noqa: E501, ",
    b"# coding: idna\n",
    b"# coding: utf-7\n",
    b"<!--",
    b"-->",
    b"<![CDATA[",
    b"&amp;",
    b"<a b='c'>",
    b"${a}",
    b"$<A:b>",
    b"[[",
    b"]]",
    b"%s",
    b"{",
    b"}",
    b"{{ a }}",
    b"*",
    b"**",
    b"->",
    b":=",
    b"=",
    b"- ",
    b": ",
    b"&a ",
    b"*a",
    b"!!python/object:a ",
    b"lambda: ",
    b"not ",
    b"1+",
    b".a",
    b"()",
    b"[0]",
    b"if a:\n ",
    b"else:\n ",
    b"elif a:\n ",
    b"def f(a=",
    b"class A(",
    b"f'{",
    b"async ",
    b"await ",
    b"match a:\n case ",
    b"global a\n",
    b"import ",
    b"from . import *\n",
    b"@a\n",
    b"yield ",
    b"-",
    b"~",
    b"9" * 5000,
    b"1e9999",
    b"0x",
    b"1_",
    b"1j",
    b"endif()\n",
    b"if(",
    b"foreach(a ",
    b"macro(a)\n",
    b"<node pkg='a' exec='b'/>",
    b"<depend>a</depend>\n",
    b"int32[<=",
    b"---\n",
    b"@verbatim(",
    b"[a]\n",
)


def mutate(files: Files, random: Random) -> tuple[Files, list[str]]:
    """Return a broken copy of a package, and how it was broken."""
    result = dict(files)
    story: list[str] = []
    for _ in range(random.choice((1, 1, 2, 4))):
        path = random.choice(sorted(result))
        if random.random() < 0.08:
            other = random.choice(sorted(result))
            result[path] = result[other]
            story.append(f"{path} = {other}")
            continue
        mutation = random.choice(MUTATIONS)
        result[path] = mutation(result[path], random)[:MOST_BYTES]
        story.append(f"{mutation.__name__.strip('_')} {path}")
    return result, story


def _span(data: bytes, random: Random, most: int = 200) -> tuple[int, int]:
    start = random.randrange(len(data) + 1)
    return start, min(len(data), start + random.randrange(1, most))


def _line(data: bytes, random: Random) -> tuple[int, int]:
    at = random.randrange(len(data) + 1)
    end = data.find(b"\n", at) + 1
    return data.rfind(b"\n", 0, at) + 1, end or len(data)


def _flip(data: bytes, random: Random) -> bytes:
    broken = bytearray(data)
    for _ in range(min(random.choice((1, 3, 30)), len(broken))):
        broken[random.randrange(len(broken))] = random.randrange(256)
    return bytes(broken)


def _delete(data: bytes, random: Random) -> bytes:
    start, end = _span(data, random)
    return data[:start] + data[end:]


def _truncate(data: bytes, random: Random) -> bytes:
    return data[: random.randrange(len(data) + 1)]


def _repeat(data: bytes, random: Random) -> bytes:
    start, end = _span(data, random, random.choice((2, 4, 20, 200)))
    count = min(random.choice(_COUNTS), MOST_BYTES // max(end - start, 1))
    return data[:start] + data[start:end] * count + data[end:]


def _repeat_line(data: bytes, random: Random) -> bytes:
    start, end = _line(data, random)
    count = min(random.choice(_COUNTS), MOST_BYTES // max(end - start, 1))
    return data[:start] + data[start:end] * count + data[end:]


def _number_lines(data: bytes, random: Random) -> bytes:
    start, end = _line(data, random)
    line = data[start:end]
    count = min(random.choice(_COUNTS), 60_000 // max(end - start, 1))
    lines = (re.sub(rb"[A-Za-z]\w+", rb"\g<0>%d" % at, line, count=2) for at in range(count))
    return data[:start] + b"".join(lines) + data[end:]


def _insert(data: bytes, random: Random) -> bytes:
    at = random.randrange(len(data) + 1)
    word = random.choice(_WORDS)
    count = random.choice((1, 1, 1, *_COUNTS))
    return data[:at] + word * min(count, MOST_BYTES // len(word)) + data[at:]


def _insert_start(data: bytes, random: Random) -> bytes:
    return random.choice(_WORDS) + data


def _nest(data: bytes, random: Random) -> bytes:
    start, end = _span(data, random, 30)
    pair, count = random.choice(_PAIRS), random.choice(_COUNTS)
    left, right = pair[:1] * count, pair[1:] * count
    return data[:start] + left + data[start:end] + right + data[end:]


def _nest_elements(data: bytes, random: Random) -> bytes:
    start, end = _span(data, random, 300)
    count = random.choice(_COUNTS)
    return data[:start] + b"<a>" * count + data[start:end] + b"</a>" * count + data[end:]


def _indent(data: bytes, random: Random) -> bytes:
    start, end = _line(data, random)
    depth = random.choice((20, 99, 101, 400))
    blocks = b"".join(b" " * at + b"if a:\n" for at in range(depth))
    return data[:start] + blocks + b" " * depth + data[start:end] + data[end:]


def _swap_words(data: bytes, random: Random) -> bytes:
    words = re.split(rb"(\w+)", data)
    places = range(1, len(words), 2)
    for _ in range(random.choice((1, 5, 50)) if len(places) > 1 else 0):
        item, other = random.choice(places), random.choice(places)
        words[item], words[other] = words[other], words[item]
    return b"".join(words)


def _swap_signs(data: bytes, random: Random) -> bytes:
    signs = re.split(rb"([^\w\s])", data)
    places = range(1, len(signs), 2)
    for _ in range(random.choice((1, 5, 50)) if len(places) > 1 else 0):
        item, other = random.choice(places), random.choice(places)
        signs[item], signs[other] = signs[other], signs[item]
    return b"".join(signs)


def _swap_lines(data: bytes, random: Random) -> bytes:
    lines = data.splitlines(keepends=True)
    random.shuffle(lines)
    return b"".join(lines)


def _one_line(data: bytes, random: Random) -> bytes:
    return data.replace(b"\n", random.choice((b"", b" ", b";", b"\r", b"\\n")))


def _encode(data: bytes, random: Random) -> bytes:
    codec = random.choice(("utf-16", "utf-32", "utf-8-sig", "utf-7", "cp037", "utf-16-le"))
    return data.decode("latin-1").encode(codec, "replace")


def _declare(data: bytes, random: Random) -> bytes:
    codecs = ("idna", "punycode", "utf-7", "hz", "latin-1", "cp1252", "rot13", "no-such", "utf-16")
    cookie = f"# -*- coding: {random.choice(codecs)} -*-\n".encode()
    return cookie + data + b"\n# \xe9\xff\n" * random.randrange(2)


def _returns(data: bytes, random: Random) -> bytes:
    return data.replace(b"\n", random.choice((b"\r\n", b"\r", b"\n\r", b"\n\n", b"\x0c\n")))


def _spaces(data: bytes, random: Random) -> bytes:
    return data.replace(b" ", random.choice((b"\t", b"  ", b"", b" \\\n", b"\xc2\xa0")))


MUTATIONS: Sequence[Mutation] = (
    _flip, _delete, _truncate, _repeat, _repeat, _repeat_line, _number_lines, _insert, _insert,
    _insert_start, _nest, _nest_elements, _indent, _swap_words, _swap_signs, _swap_lines, _one_line,
    _encode, _declare, _returns, _spaces,
)  # fmt: skip
