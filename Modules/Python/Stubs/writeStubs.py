"""Writes the stubs of a module that VTK wrapped: python3 writeStubs.py MODULE FILE.pyi. Its docstrings hold the signatures."""

import importlib
import keyword
import re
import sys

_SIGNATURE = re.compile(r"^(\w+)\((.*?)\) *(?:-> *(.+))?$")
_SIMPLE = {"int", "float", "bool", "str", "bytes", "None", "string", "void", "char", "bytearray", "object", "unicode"}
_OF_NUMPY = {"string": "str", "unicode": "str", "char": "str", "void": "None"}


def type_of(text, classes):
    """The type that VTK's text names, as far as stubs know it."""
    text = (text or "None").strip()
    if text in _SIMPLE:
        return _OF_NUMPY.get(text, text)
    if text in classes:
        return text
    inner = re.fullmatch(r"\((.*?)(, *\.\.\.)?\)", text)
    if inner and re.fullmatch(r"[\w, ]*", inner[1]):
        parts = [type_of(part, classes) for part in inner[1].split(",") if part.strip()]
        return f"Tuple[{', '.join(parts)}{', ...' if inner[2] else ''}]"
    return "Any"


def split(arguments):
    """The arguments, cut at the commas that stand in no brackets."""
    return [part.strip() for part in re.split(r",(?![^(\[]*[)\]])", arguments) if part.strip()]


def parameters_of(arguments, classes):
    result = ["self"]
    for i, argument in enumerate(split(arguments)):
        name, _, kind = argument.partition(":")
        if name == "self":
            continue
        kind, equals, _ = kind.partition("=")
        name = name if name.isidentifier() and not keyword.iskeyword(name) else f"argument{i}"
        # Any sequence does where VTK's text has a tuple.
        given = re.sub(r"^Tuple\[.*", "Sequence[Any]", type_of(kind, classes))
        result.append(f"{name}: {given}{' = ...' if equals else ''}")
    return ", ".join(result)


def signatures_of(method, name, classes):
    """The signatures of the docstring, which has each before its C++ one."""
    result = []
    text = re.split(r"\n\n", method.__doc__ or "", maxsplit=1)[0]
    for part in re.split(r"\n?C\+\+:[^\n]*(?:\n    [^\n]*)*\n?", text):
        match = _SIGNATURE.match(" ".join(part.split()))
        if match and match[1] == name:
            signature = f"({parameters_of(match[2], classes)}) -> {type_of(match[3], classes)}"
            if signature not in result:
                result.append(signature)
    return result or ["(self, *arguments: Any) -> Any"]


def stub_of(cls, classes):
    # Types of this package come by their own names, those of VTK's modules have no stubs.
    base = cls.__mro__[1].__name__ if cls.__mro__[1].__name__ in classes else "Any"
    ignored = "  # type: ignore[misc]" if base == "Any" else ""
    lines = [f"class {cls.__name__}({base}):{ignored}"]
    for name, value in sorted(vars(cls).items()):
        if keyword.iskeyword(name) or (name.startswith("_") and name != "__init__"):
            continue
        if callable(value) and not isinstance(value, type):
            signatures = signatures_of(value, name, classes)
            for signature in signatures:
                if len(signatures) > 1:
                    lines.append("    @overload")
                if "C++: static" in (value.__doc__ or ""):
                    lines.append("    @staticmethod")
                    signature = re.sub(r"^\(self(, )?", "(", signature)
                lines.append(f"    def {name}{signature}: ...")
        elif isinstance(value, int):
            lines.append(f"    {name}: int")
    return lines + ["    ..."] * (len(lines) == 1)


def main(module_name, file_name):
    module = importlib.import_module(module_name)
    classes = {name: value for name, value in vars(module).items() if isinstance(value, type) and name.startswith("vtk")}
    lines = ["# Written by writeStubs.py.", "from typing import Any, Sequence, Tuple, overload", ""]
    for _, cls in sorted(classes.items()):
        lines.extend([*stub_of(cls, classes), ""])
    with open(file_name, "w") as file:
        file.write("\n".join(lines))


if __name__ == "__main__":
    main(*sys.argv[1:])
