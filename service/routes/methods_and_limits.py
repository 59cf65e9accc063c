"""The methods, the formats, the exports and the limits of the service."""

from fastapi import APIRouter, Response
from pydantic import BaseModel

from caesura.core.limits import Limits
from caesura.core.parameters import ALGORITHM, Parameters
from caesura.service.api_description.format_documents import FormatDocument, format_documents
from caesura.service.api_description.method_schemas import MethodDocument, describe_methods
from caesura.service.backend import BackendDependency
from caesura.service.results.result_formats import EngineDocument, ExportDocument, engine_descriptions, export_documents
from caesura.service.segmentations.document_response import document_response

router = APIRouter(prefix="/v1", tags=["about"])


class MethodList(BaseModel):
    """The methods, the one that is taken where none is named, and the version of all of them."""

    algorithm: str
    default: str
    methods: tuple[MethodDocument, ...]


class ExportList(BaseModel):
    """The files that are made of a result, and the programs that their clips are for."""

    exports: tuple[ExportDocument, ...]
    engines: tuple[EngineDocument, ...]


class FormatList(BaseModel):
    """The kinds of files that are read."""

    formats: tuple[FormatDocument, ...]


class LimitsDocument(Limits):
    """How large an upload, a model and a collection may be."""

    max_upload_bytes: int
    max_collection_takes: int
    max_collection_seconds: float


@router.get("/methods", response_model=MethodList)
async def list_methods() -> Response:
    """List the methods, each with the JSON Schema of its parameters."""
    default = Parameters.model_fields["method"].default
    return document_response(MethodList(algorithm=ALGORITHM, default=default, methods=describe_methods()))


@router.get("/exports", response_model=ExportList)
async def list_exports() -> Response:
    """List the files that are made of a result.

    The answer says where each is and what it is for, and how programs import clips.
    """
    return document_response(ExportList(exports=export_documents(), engines=engine_descriptions()))


@router.get("/formats", response_model=FormatList)
async def list_formats() -> Response:
    """List the kinds of files that are read.

    The answer says how their names end, and what of them is read.
    """
    return document_response(FormatList(formats=format_documents()))


@router.get("/limits", response_model=LimitsDocument)
async def get_limits(backend: BackendDependency) -> Response:
    """Tell how large an upload, a model and a collection may be here."""
    settings = backend.settings
    beside = {name: getattr(settings, name) for name in LimitsDocument.model_fields.keys() - Limits.model_fields.keys()}
    return document_response(LimitsDocument(**settings.limits.model_dump(), **beside))
