"""Error messages for malformed XML, clearer than those of expat."""

from __future__ import annotations

import re
from collections.abc import Callable
from xml.parsers.expat import errors

from scaffold import lazy_re
from scaffold.formats.xml import BLANK, BOM, Element
from scaffold.source import ParseError, Source

_REFERENCE = lazy_re.compile(r"&(?:#[0-9]+|#x[0-9A-Fa-f]+|[A-Za-z_:][\w:.\-]*);")
_NAME = lazy_re.compile(r"[^\s<>/=\"'&]+")
_NEAR = 4096  # characters; errors further away are unrelated
_TYPOGRAPHIC_QUOTES = "\u201c\u201d\u2018\u2019"
Explanation = tuple[int, int, str]


def explain(source: Source, code: int, at: int, inside: Element | None) -> ParseError:
    """Return the message for an error of expat.

    Args:
        source: The file.
        code: The error code of expat.
        at: The offset where expat stopped.
        inside: The innermost element open at this offset.
    """
    error = errors.messages[code]
    explained = _text_before_declaration(source.text)
    if explained is None and error in _OF_ELEMENTS:
        explained = _OF_ELEMENTS[error](source, at, inside)
    if explained is None and error in _OF_TEXT:
        explained = _OF_TEXT[error](source.text, at)
    if explained is None:
        explained = _not_well_formed(source.text, at, inside) or (at, at + 1, error)
    start, end, message = explained
    return ParseError(source.location(start, end), message)


def _text_before_declaration(text: str) -> Explanation | None:
    """Return whether anything precedes ``<?xml``."""
    begin = 1 if text.startswith(BOM) else 0
    at = text.find("<?xml", begin, begin + 4096)
    if at <= begin or text[at + 5 : at + 6] not in {*BLANK, "?"}:
        return None
    before = text[begin:at]
    if "<" in before.replace("<!--", ""):
        return None
    if before.strip(BLANK + BOM):
        subject = "text" if "<!--" not in before else "a comment"
    else:
        subject = "a blank line" if "\n" in before else "a space"
    return begin, at, f'{subject} before "<?xml": it must come first'


def _after_root(text: str, at: int) -> Explanation:
    last = max(text.rfind("</", 0, at), text.rfind("/>", 0, at))
    closing = text[last : text.find(">", last) + 1] if text.startswith("</", last) else "/>"
    if text.startswith("</", at):
        name = f"</{_name_at(text, at + 2)}>"
        return at, at + len(name), f"{name} closes nothing: the root element is closed already"
    if text.startswith("<", at):
        name = f"<{_name_at(text, at + 1)}"
        return at, at + len(name), f"{name}> after {closing}, the end of the root element"
    return at, at + 1, f"text after {closing}, the end of the root element"


def _duplicate_attribute(text: str, at: int) -> Explanation:
    name = _name_at(text, at)
    return at, at + len(name), f"the attribute {name!r} is a duplicate"


def _undefined_entity(text: str, at: int) -> Explanation:
    name = _reference(text, at)
    return at, at + len(name), f'"{name}" means nothing in package.xml: write the character'


def _bad_reference(text: str, at: int) -> Explanation:
    name = _reference(text, at)
    return at, at + len(name), f'"{name}" is not a character that XML allows'


def _misplaced_declaration(_text: str, at: int) -> Explanation:
    return at, at + len("<?xml"), '"<?xml" is allowed only at the very start of the file'


def _broken_declaration(text: str, at: int) -> Explanation:
    start = 1 if text.startswith(BOM) else 0
    end = max(at, _tag_close(text, at) + 1)
    return start, end, 'write the first line as <?xml version="1.0"?>'


def _unclosed_cdata(text: str, at: int) -> Explanation:
    start = max(text.rfind("<![CDATA[", 0, at + 1), 0)
    return start, start + 9, '"]]>" expected: this CDATA section is not closed'


def _mismatch(source: Source, at: int, inside: Element | None) -> Explanation:
    text = source.text
    start = text.rfind("</", 0, at + 2)
    start = at if start < 0 else start
    end = start + 2 + len(_name_at(text, start + 2))
    if inside is None:
        return start, end, "this end tag closes nothing"
    line, _ = source.position(inside.start)
    tag = inside.tag
    return start, end, f"</{tag}> expected, <{tag}> opened at line {line} is not closed"


def _end_of_file(source: Source, _at: int, inside: Element | None) -> Explanation:
    end = len(source.text)
    if inside is not None:
        line, _ = source.position(inside.start)
        return end, end, f"end of file, but <{inside.tag}> opened at line {line} is not closed"
    if source.text.strip(BLANK + BOM):
        return end, end, "end of file, but there is no element such as <package>"
    return 0, 0, "the file is empty"


def _unclosed(source: Source, at: int, inside: Element | None) -> Explanation:
    text = source.text
    for opening, closing, name in (
        ("<!--", "-->", "comment"),
        ("<![CDATA[", "]]>", "CDATA section"),
        ("<?", "?>", "processing instruction"),
    ):
        if text.startswith(opening, at):
            return at, at + len(opening), f'"{closing}" expected: this {name} is not closed'
    if text.startswith("</", at) and inside is not None:
        return at, len(text), f"</{inside.tag}> expected, the file ends inside of it"
    if text.startswith("<", at):
        name = _name_at(text, at + 1)
        for quote in "\"'":
            if text.count(quote, at) % 2:
                opened = text.find(quote, at)
                return opened, opened + 1, f"a second {quote} expected: the value is not closed"
        return at, at + 1 + len(name), f'">" expected: the tag <{name} is not closed'
    if text.startswith("&", at):
        return at, at + 1, 'write "&amp;" for "&"'
    return at, at, "the file ends in the middle of something"


def _unbound_prefix(text: str, at: int) -> Explanation:
    start = at + 1 if text.startswith("<", at) else at
    name = _name_at(text, start)
    end = _tag_close(text, start)
    for match in re.finditer(r"[ \t\r\n]([^\s=:\"'<>]+):[^\s=\"'<>]+[ \t\r\n]*=", text[start:end]):
        if ":" not in name and match[1] not in {"xml", "xmlns"}:
            begin = start + match.start(1)
            return begin, begin + len(match[1]), f'the prefix "{match[1]}:" is not declared'
    prefix = name.partition(":")[0]
    return start, start + len(name), f'the prefix "{prefix}:" is not declared'


def _not_well_formed(text: str, at: int, inside: Element | None) -> Explanation | None:
    """Explain an unspecific error of expat from the surrounding text."""
    result = _bad_character(text, at) or _ampersand(text, at) or _in_comment(text, at)
    if result is not None:
        return result
    if text.startswith("]]>", at) or text.startswith("]]>", max(0, at - 2)):
        start = text.rfind("]]>", 0, at + 3)
        return start, start + 3, 'write "]]&gt;" for "]]>"'
    end_tag = at if text.startswith("</", at) else at - 1
    if text.startswith("</", max(end_tag, 0)):
        if _opening(text, end_tag) == end_tag:
            end = end_tag + 2 + len(_name_at(text, end_tag + 2))
            return end_tag, end, "this end tag closes nothing"
        at = end_tag
    opening = _opening(text, at)
    if opening >= 0 and ">" not in _outside_quotes(text[opening:at]):
        return _in_tag(text, opening, at)
    if inside is None:
        return at, at + 1, "text outside of the root element"
    return None


def _bad_character(text: str, at: int) -> Explanation | None:
    character = text[at : at + 1]
    if character in BLANK or character.isprintable():
        return None
    return at, at + 1, f"the character U+{ord(character):04X} is not allowed here"


def _ampersand(text: str, at: int) -> Explanation | None:
    start = text.rfind("&", max(0, at - _NEAR), at + 1)
    if start < 0 or _REFERENCE.match(text, start) or re.search(r"[<>\n]", text[start:at]):
        return None
    return start, start + 1, 'write "&amp;" for "&"'


def _in_comment(text: str, at: int) -> Explanation | None:
    comment = text.rfind("<!--", 0, at)
    if comment <= text.rfind("-->", 0, at) or not text.startswith("-", at - 1):
        return None
    start = text.rfind("--", comment + 4, at + 2)
    start = at if start < 0 else start
    return start, start + 2, '"--" is not allowed inside a comment'


def _in_tag(text: str, opening: int, at: int) -> Explanation:
    """Explain an error between ``<`` and ``>``."""
    if text.startswith("<!", opening):
        return opening, opening + 2, '"<!" begins neither a comment nor a CDATA section'
    if not re.match(r"[/?]?(?:[^\W\d]|:)", text[opening + 1 : opening + 3]):
        return opening, opening + 1, 'write "&lt;" for "<", or a tag name after it'
    tag, character = f"<{_name_at(text, opening + 1)}", text[at : at + 1]
    before = text[opening:at].rstrip(BLANK)
    width = 1
    if character and character in _TYPOGRAPHIC_QUOTES:
        message = f"write a plain quote for {character}"
    elif character == "<" and _open_quote(text[opening:at]):
        message = 'write "&lt;" for "<" in a value, or close the value with a quote'
    elif character == "<":
        return opening, at, f'">" expected: the tag {tag} is not closed'
    elif before.endswith("="):
        message = f"a value in quotes expected in the tag {tag}>"
    elif before.endswith(("'", '"')) and len(before) == at - opening:
        message = f"a space expected between attributes of {tag}>"
        width = max(len(_name_at(text, at)), 1)
    elif character == ">" or re.search(r"[ \t\r\n][^\s=\"'<>]+$", before):
        message = f"an attribute of {tag}> has no value"
    elif text.startswith("<?", opening):
        message = f"the instruction {tag} is not written right"
    else:
        message = f"{character!r} is not expected in the tag {tag}>"
    return at, at + width, message


def _reference(text: str, at: int) -> str:
    match = _REFERENCE.match(text, at)
    return match[0] if match else "&"


def _opening(text: str, at: int) -> int:
    """Return the start of the tag around an offset, or -1."""
    before = text.rfind("<", max(0, at - _NEAR), at)
    if text.startswith("<", at) and (before < 0 or ">" in _outside_quotes(text[before:at])):
        return at
    return before


def _name_at(text: str, at: int) -> str:
    match = _NAME.match(text, at)
    return match[0] if match else ""


def _open_quote(text: str) -> bool:
    quote = ""
    for char in text:
        if quote:
            quote = "" if char == quote else quote
        elif char in "\"'":
            quote = char
    return bool(quote)


def _outside_quotes(text: str) -> str:
    return re.sub(r"\"[^\"]*\"|'[^']*'", "", text)


def _tag_close(text: str, start: int) -> int:
    end = text.find(">", start)
    return len(text) if end < 0 else end


_OF_ELEMENTS: dict[str, Callable[[Source, int, Element | None], Explanation]] = {
    errors.XML_ERROR_TAG_MISMATCH: _mismatch,
    errors.XML_ERROR_NO_ELEMENTS: _end_of_file,
    errors.XML_ERROR_UNCLOSED_TOKEN: _unclosed,
    errors.XML_ERROR_PARTIAL_CHAR: _unclosed,
}
_OF_TEXT: dict[str, Callable[[str, int], Explanation]] = {
    errors.XML_ERROR_UNCLOSED_CDATA_SECTION: _unclosed_cdata,
    errors.XML_ERROR_JUNK_AFTER_DOC_ELEMENT: _after_root,
    errors.XML_ERROR_DUPLICATE_ATTRIBUTE: _duplicate_attribute,
    errors.XML_ERROR_UNDEFINED_ENTITY: _undefined_entity,
    errors.XML_ERROR_BAD_CHAR_REF: _bad_reference,
    errors.XML_ERROR_UNBOUND_PREFIX: _unbound_prefix,
    errors.XML_ERROR_MISPLACED_XML_PI: _misplaced_declaration,
    errors.XML_ERROR_XML_DECL: _broken_declaration,
}
