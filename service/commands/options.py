"""Every parameter of the method as an option, made from `caesura.core.parameters`: one spelling, one description."""

from collections.abc import Callable
from typing import Annotated, Any, get_args, get_origin

import click
from click.shell_completion import CompletionItem
from pydantic.fields import FieldInfo

from caesura.core.parameters import Parameters
from caesura.formats.clips.clip_options import ClipOptions


def parameter_option_decorators(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add an option for each parameter; the command receives those given, as text, among its keyword arguments.

    Names are written with dashes or underscores. Values stay text: `Parameters.parse` judges them, as it does a
    query string's.
    """
    return parameter_options_without()(function)


def parameter_options_without(*names: str) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """The same decorator, with options for all parameters but these."""

    def decorate(function: Callable[..., Any]) -> Callable[..., Any]:
        for name, field in reversed(Parameters.model_fields.items()):
            if name not in names:
                function = _option(name, field)(function)
        return function

    return decorate


def clip_option_decorators(function: Callable[..., Any]) -> Callable[..., Any]:
    """Add an option for each choice of clips; the command receives it as `clip_NAME`, for `files` is its own."""
    for name, field in reversed(ClipOptions.model_fields.items()):
        flag, text = f"--{name.replace('_', '-')}", f"{field.description}  [of --clips]"
        if field.annotation is bool:
            option = click.option(flag, f"clip_{name}", is_flag=True, default=None, help=text)
        else:
            option = click.option(flag, f"clip_{name}", metavar=_metavar(field.annotation), help=text)
        function = option(function)
    return function


def given_clip_options(arguments: dict[str, Any]) -> ClipOptions:
    """The choices that were given, out of a command's keyword arguments."""
    named = {name: arguments[f"clip_{name}"] for name in ClipOptions.model_fields}
    return ClipOptions.of({name: value for name, value in named.items() if value is not None})


def given_parameters(arguments: dict[str, Any]) -> dict[str, str]:
    """The parameters that were given, out of a command's keyword arguments."""
    return {name: arguments[name] for name in Parameters.model_fields if arguments.get(name) is not None}


def with_dashes(token: str) -> str:
    """`--window_seconds`, as the API spells it, is `--window-seconds`."""
    return token.replace("_", "-")


def _option(name: str, field: FieldInfo) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    flag = f"--{name.replace('_', '-')}"
    if field.annotation is bool:
        return click.option(f"{flag}/--no-{flag[2:]}", name, default=None, help=field.description)
    default = f"{field.description}  [default: {field.default}]"
    metavar = _metavar(field.annotation)
    words = [word for word in metavar.split("|") if not word.isupper()]

    def complete(_: click.Context, __: click.Parameter, begun: str) -> list[CompletionItem]:
        return [CompletionItem(word) for word in words if word.startswith(begun)]

    return click.option(flag, name, metavar=metavar, help=default, shell_complete=complete)


def _metavar(annotation: Any) -> str:
    """What may stand there: `auto|INTEGER` for `Literal["auto"] | int`."""
    kinds = {int: "INTEGER", float: "NUMBER", str: "TEXT"}
    if annotation in kinds:
        return kinds[annotation]
    parts = get_args(annotation)
    if get_origin(annotation) is Annotated:
        parts = parts[:1]  # the rest are rules
    return "|".join(part if isinstance(part, str) else _metavar(part) for part in parts)
