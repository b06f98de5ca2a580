"""Recipes for the messages of type_description_interfaces."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

RECIPES: dict[str, Recipe] = {
    "Field": Recipe(
        summary="a field with a number, whose default grows",
        code="""
            msg.name = 'number'
            msg.type.type_id = FieldType.FIELD_TYPE_INT32
            msg.default_value = str(self.count)
        """,
        log="{msg.name}: {msg.default_value}",
        checks=(
            "message.name == 'number'",
            "message.default_value.isdigit()",
        ),
    ),
    "FieldType": Recipe(
        summary="the type of an array of numbers, whose size grows",
        code="""
            msg.type_id = FieldType.FIELD_TYPE_INT32_ARRAY
            msg.capacity = self.count % 100 + 1
        """,
        log="type {msg.type_id}[{msg.capacity}]",
        checks=(
            "message.type_id == FieldType.FIELD_TYPE_INT32_ARRAY",
            "1 <= message.capacity <= 100",
        ),
    ),
    "IndividualTypeDescription": Recipe(
        summary="a type with one field, whose default grows",
        code="""
            field = Field(name='number', default_value=str(self.count))
            field.type.type_id = FieldType.FIELD_TYPE_INT32
            msg.type_name = 'example/msg/Number'
            msg.fields = [field]
        """,
        log="{msg.type_name}",
        checks=("message.type_name == 'example/msg/Number'", "len(message.fields) == 1"),
    ),
    "KeyValue": Recipe(
        summary="a number with its name",
        code="""
            msg.key = 'number'
            msg.value = str(self.count)
        """,
        log="{msg.key}: {msg.value}",
        checks=("message.key == 'number'", "message.value.isdigit()"),
    ),
    "TypeDescription": Recipe(
        summary="a type with one field, whose default grows",
        code="""
            field = Field(name='number', default_value=str(self.count))
            field.type.type_id = FieldType.FIELD_TYPE_INT32
            msg.type_description.type_name = 'example/msg/Number'
            msg.type_description.fields = [field]
        """,
        log="{msg.type_description.type_name}",
        checks=(
            "message.type_description.type_name == 'example/msg/Number'",
            "len(message.type_description.fields) == 1",
        ),
    ),
    "TypeSource": Recipe(
        summary="the text of a type with one field, whose default grows",
        code="""
            msg.type_name = 'example/msg/Number'
            msg.encoding = 'msg'
            msg.raw_file_contents = f'int32 number {self.count}'
        """,
        log="{msg.raw_file_contents}",
        checks=(
            "message.encoding == 'msg'",
            "message.raw_file_contents.startswith('int32 number ')",
        ),
    ),
}
