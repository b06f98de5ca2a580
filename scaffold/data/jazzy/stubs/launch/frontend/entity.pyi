from typing import Any

class Entity:
    @property
    def type_name(self) -> str: ...
    @property
    def parent(self) -> Entity | None: ...
    @property
    def children(self) -> list[Entity]: ...
    def get_attr(
        self,
        name: str,
        *,
        data_type: Any = ...,
        optional: bool = False,
        can_be_str: bool = True,
    ) -> Any: ...
    def assert_entity_completely_parsed(self) -> None: ...
