"""Recipes for the messages of std_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

_SINE = Recipe(
    summary="a sine wave",
    code="msg.data = math.sin(self.count / 10.0)",
    log="{msg.data:.3f}",
    checks=("-1.0 <= message.data <= 1.0",),
)


def _counter(bits: int) -> Recipe:
    """Return a counter that wraps around before an integer overflows."""
    end = 2**bits - 1
    limit = str(end + 1) if bits <= 16 else f"2**{bits}"  # noqa: PLR2004  readable up to 65536
    return Recipe(
        summary=f"a counter from 0 to {end}",
        code=f"msg.data = self.count % {limit}",
        log="{msg.data}",
        checks=(f"0 <= message.data < {limit}",),
    )


_ENDLESS = Recipe(
    summary="a counter",
    code="msg.data = self.count",
    log="{msg.data}",
    checks=("0 <= message.data",),
)


def _matrix(value: str, words: str, form: str = "") -> Recipe:
    return Recipe(
        summary=f"a matrix of 2 rows and 3 columns with {words}",
        code=f"""
            msg.layout.dim = [
                MultiArrayDimension(label='rows', size=2, stride=6),
                MultiArrayDimension(label='columns', size=3, stride=3),
            ]
            msg.data = [{value} for index in range(6)]
        """,
        log=f"{{msg.data[0]{form}}} to {{msg.data[-1]{form}}}",
        checks=("len(message.data) == message.layout.dim[0].stride",),
    )


_COUNTERS = _matrix("(self.count + index) % 100", "counters")
_WAVES = _matrix("math.sin(self.count / 10.0 + index)", "sine waves", ":.2f")

RECIPES: dict[str, Recipe] = {
    "Bool": Recipe(
        summary="true and false in turn",
        code="msg.data = self.count % 2 == 0",
        log="{msg.data}",
        checks=("isinstance(message.data, bool)",),
    ),
    "Byte": Recipe(
        summary="a counter from 0 to 255 in one byte",
        code="msg.data = bytes([self.count % 256])",
        log="{msg.data}",
        checks=("len(message.data) == 1",),
    ),
    "ByteMultiArray": _matrix("bytes([(self.count + index) % 256])", "counters of one byte each"),
    "Char": _counter(8),
    "ColorRGBA": Recipe(
        summary="a color that goes from blue to red and back",
        code="""
            msg.r = 0.5 + 0.5 * math.sin(self.count / 10.0)  # 0.0 to 1.0
            msg.b = 1.0 - msg.r
            msg.a = 1.0  # opaque
        """,
        log="red {msg.r:.2f}, blue {msg.b:.2f}",
        checks=("0.0 <= message.r <= 1.0", "message.a == 1.0"),
    ),
    "Empty": Recipe(summary="nothing: an event without data", log="an empty message"),
    "Float32": _SINE,
    "Float64": _SINE,
    "Float32MultiArray": _WAVES,
    "Float64MultiArray": _WAVES,
    "Header": Recipe(
        summary="the time of publication and the name of a frame",
        code="""
            msg.stamp = self.get_clock().now().to_msg()
            msg.frame_id = self.frame_id
        """,
        log="{msg.stamp.sec} s in {msg.frame_id}",
        checks=("abs(time.time() - message.stamp.sec) < 60", "message.frame_id"),
    ),
    **{f"Int{bits}": _counter(bits - 1) for bits in (8, 16, 32)},
    **{f"UInt{bits}": _counter(bits) for bits in (8, 16, 32)},
    "Int64": _ENDLESS,
    "UInt64": _ENDLESS,
    **{f"{sign}Int{bits}MultiArray": _COUNTERS for sign in ("", "U") for bits in (8, 16, 32, 64)},
    "MultiArrayDimension": Recipe(
        summary="a dimension of an array that grows",
        code="""
            msg.label = 'rows'
            msg.size = self.count % 100 + 1
            msg.stride = msg.size * 3  # of rows with 3 columns
        """,
        log="{msg.label}: {msg.size}",
        checks=("message.stride == 3 * message.size",),
    ),
    "MultiArrayLayout": Recipe(
        summary="the layout of an array with a growing number of rows and 3 columns",
        code="""
            rows = self.count % 100 + 1
            msg.dim = [
                MultiArrayDimension(label='rows', size=rows, stride=rows * 3),
                MultiArrayDimension(label='columns', size=3, stride=3),
            ]
        """,
        log="{msg.dim[0].size} rows, {msg.dim[1].size} columns",
        checks=("[dim.label for dim in message.dim] == ['rows', 'columns']",),
    ),
    "String": Recipe(
        summary="a greeting with a counter",
        code="msg.data = f'Hello World: {self.count}'",
        log="{msg.data}",
        checks=("message.data.startswith('Hello World: ')",),
    ),
}
