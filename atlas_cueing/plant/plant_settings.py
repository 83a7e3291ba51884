"""`[plant]` of a platform with settings of the command line on top."""

from collections.abc import Sequence

from pydantic import ValidationError

from ..errors import InputError
from ..scenario import Platform
from ..scenario.overrides import parse_overrides
from ..scenario.plant_table import PlantTable

_BEFORE = ("platform", "plant")


def plant_table(platform: Platform, settings: Sequence[str]) -> PlantTable:
    """The platform's `[plant]` with `platform.plant.KEY=VALUE` texts on top.

    Raises InputError for other keys, and for values that are not allowed.
    """
    given = platform.plant.model_dump() if platform.plant else {}
    for key, value in parse_overrides(settings).items():
        if len(key) != 3 or key[:2] != _BEFORE or key[2] not in PlantTable.model_fields:
            raise InputError(
                f"--set: {'.'.join(map(str, key))}: allowed: platform.plant.KEY with one of"
                f" {', '.join(PlantTable.model_fields)}"
            )
        given[str(key[2])] = value
    try:
        return PlantTable.model_validate(given)
    except ValidationError as error:
        raise InputError(
            *(
                f"--set: {'.'.join(map(str, (*_BEFORE, *detail['loc'])))} = {detail['input']!r},"
                f" allowed: {detail['msg']}"
                for detail in error.errors(include_url=False)
            )
        ) from error
