# SPDX-License-Identifier: GPL-3.0-or-later
"""The stub file names what the package has, with the same parameters; everything has a docstring."""

import ast
import inspect
import pathlib
import re

import pytest

import lodestone

stub = ast.parse((pathlib.Path(lodestone.__file__).parent / "__init__.pyi").read_text())
classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
only_in_stub = {
    "Has_mesh", "Closest", "Impact", "Object_impact", "Hit", "Object_hit", "Hits", "Closest_point", "Closest_points",
    "Patch",
}


def parameters_in_stub(node):
    arguments = node.args
    return [a.arg for a in arguments.posonlyargs + arguments.args + arguments.kwonlyargs if a.arg != "self"]


def parameters_of(function):
    """From the signature, or from the first line of the docstring of a compiled function."""
    try:
        return [p.name for p in inspect.signature(function).parameters.values()
                if p.name != "self" and p.kind is not p.VAR_KEYWORD]
    except ValueError:
        signature = re.match(r"\w+\((.*?)\) ->", function.__doc__).group(1)
        names = re.findall(r"(?:^|, )(\w+):", signature)
        return [name for name in names if name != "self"]


def test_the_stub_has_all_names():
    assert set(lodestone.__all__) - {"__version__"} == (set(classes) | set(functions)) - only_in_stub


@pytest.mark.parametrize("name", sorted(functions))
def test_functions_have_the_parameters_of_the_stub(name):
    assert parameters_of(getattr(lodestone, name)) == parameters_in_stub(functions[name])
    assert getattr(lodestone, name).__doc__


@pytest.mark.parametrize("name", sorted(set(classes) - only_in_stub))
def test_classes_have_the_members_of_the_stub(name):
    cls = getattr(lodestone, name)
    if issubclass(cls, Exception):
        return
    members = {node.name: node for node in classes[name].body if isinstance(node, ast.FunctionDef)}
    public = {m for m in dir(cls) if not m.startswith("_") and m != "height"}
    assert public == {m for m in members if not m.startswith("_")}
    for member in public:
        found = inspect.getattr_static(cls, member)
        assert getattr(cls, member).__doc__, f"{name}.{member} has no docstring"
        if not isinstance(found, property):
            assert parameters_of(getattr(cls, member)) == parameters_in_stub(members[member]), member
    assert cls.__doc__


def test_the_options_of_the_stub_are_those_of_the_detector():
    init = next(n for n in classes["Detector"].body if isinstance(n, ast.FunctionDef) and n.name == "__init__")
    with pytest.raises(TypeError) as error:
        lodestone.Detector(no_such_option=1)
    told = re.search("there are (.*)", str(error.value)).group(1).split(", ")
    assert sorted(told) == sorted(parameters_in_stub(init))
