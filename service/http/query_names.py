"""Query names: those the API documents, once each. A misspelt option must not be silently ignored."""

from fastapi import FastAPI, Request

from caesura.core.errors import ParameterError


async def refuse_unknown_names(request: Request) -> None:
    """Refuse a query name that this call does not know, naming those it does; and one that is given twice."""
    given = [name for name, _ in request.query_params.multi_items()]
    if not given:
        return
    known = _documented_names(request.app, request.scope["route"].path, request.method.lower())
    for name in given:
        if name not in known:
            listed = f"Known: {', '.join(known)}" if known else "This call takes none"
            raise ParameterError("unknown-parameter", f"There is no parameter {name!r} here. {listed}.", parameter=name)
        if given.count(name) > 1:
            raise ParameterError("repeated-parameter", f"{name} is given more than once. Say it once.", parameter=name)


def _documented_names(app: FastAPI, path: str, method: str) -> list[str]:
    """The query names of a call, as the OpenAPI document lists them."""
    parameters = app.openapi()["paths"].get(path, {}).get(method, {}).get("parameters", [])
    return [parameter["name"] for parameter in parameters if parameter["in"] == "query"]
