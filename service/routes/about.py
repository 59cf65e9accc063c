"""What the service offers, and how much it takes."""

from fastapi import APIRouter, Response
from pydantic import BaseModel

from caesura.core.limits import Limits
from caesura.core.parameters import ALGORITHM, Parameters
from caesura.service.api_description.method_schemas import MethodDocument, describe_methods
from caesura.service.backend import BackendDependency
from caesura.service.results.result_formats import EXPORTS, ExportDocument
from caesura.service.segmentations.status_response import status_response

router = APIRouter(prefix="/v1", tags=["about"])


class MethodList(BaseModel):
    """The methods, the one that is taken where none is named, and the version of all of them."""

    algorithm: str
    default: str
    methods: tuple[MethodDocument, ...]


class ExportList(BaseModel):
    """The files that are made of a result."""

    exports: tuple[ExportDocument, ...]


class LimitsDocument(Limits):
    """How large an upload and a model may be."""

    max_upload_bytes: int


@router.get("/methods", response_model=MethodList)
async def list_methods() -> Response:
    """The methods, each with the JSON Schema of its parameters."""
    default = Parameters.model_fields["method"].default
    return status_response(MethodList(algorithm=ALGORITHM, default=default, methods=describe_methods()))


@router.get("/exports", response_model=ExportList)
async def list_exports() -> Response:
    """The files that are made of a result: where each is, what it is called, and what it is for."""
    return status_response(ExportList(exports=EXPORTS))


@router.get("/limits", response_model=LimitsDocument)
async def limits(backend: BackendDependency) -> Response:
    """How large an upload and a model may be here."""
    settings = backend.settings
    return status_response(LimitsDocument(**settings.limits.model_dump(), max_upload_bytes=settings.max_upload_bytes))
