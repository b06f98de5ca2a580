"""Recipes for the messages of sensor_msgs."""

from __future__ import annotations

from scaffold.generate.payload.recipe import Recipe

_SCAN = """
    msg.angle_min = -math.pi  # radians
    msg.angle_increment = 2.0 * math.pi / RAYS
    msg.angle_max = msg.angle_min + msg.angle_increment * (RAYS - 1)
    msg.scan_time = 0.1  # seconds
    msg.time_increment = msg.scan_time / RAYS
    msg.range_min = 0.1  # meters
    msg.range_max = 10.0
"""

RECIPES: dict[str, Recipe] = {
    "BatteryState": Recipe(
        summary="the state of a battery of three cells that discharges",
        code="""
            msg.percentage = 1.0 - self.count % 1000 / 1000.0  # 0.0 to 1.0
            msg.cell_voltage = [3.3 + 0.9 * msg.percentage] * 3  # volts
            msg.voltage = 3 * msg.cell_voltage[0]
            msg.current = -1.5  # amperes; negative while it discharges
            msg.temperature = 25.0  # degrees Celsius
            msg.capacity = 5.0  # ampere hours
            msg.design_capacity = 5.2
            msg.charge = msg.percentage * msg.capacity
            msg.power_supply_status = BatteryState.POWER_SUPPLY_STATUS_DISCHARGING
            msg.power_supply_health = BatteryState.POWER_SUPPLY_HEALTH_GOOD
            msg.power_supply_technology = BatteryState.POWER_SUPPLY_TECHNOLOGY_LION
            msg.present = True
        """,
        log="{msg.percentage:.1%}, {msg.voltage:.2f} V",
        checks=(
            "0.0 < message.percentage <= 1.0",
            "9.9 <= message.voltage <= 12.7",
            "message.voltage == pytest.approx(sum(message.cell_voltage))",
            "message.charge == pytest.approx(message.percentage * message.capacity)",
            "message.power_supply_status == BatteryState.POWER_SUPPLY_STATUS_DISCHARGING",
            "message.power_supply_health == BatteryState.POWER_SUPPLY_HEALTH_GOOD",
            "message.power_supply_technology == BatteryState.POWER_SUPPLY_TECHNOLOGY_LION",
        ),
    ),
    "CameraInfo": Recipe(
        summary="the calibration of a camera without distortion",
        constants="""
            WIDTH = 640  # pixels
            HEIGHT = 480
            FOCAL_LENGTH = 500.0  # pixels
        """,
        code="""
            msg.width = WIDTH
            msg.height = HEIGHT
            msg.distortion_model = 'plumb_bob'
            msg.d = [0.0] * 5
            x, y = WIDTH / 2.0, HEIGHT / 2.0  # where the optical axis meets the image
            msg.k = [FOCAL_LENGTH, 0.0, x, 0.0, FOCAL_LENGTH, y, 0.0, 0.0, 1.0]
            msg.r = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
            msg.p = [FOCAL_LENGTH, 0.0, x, 0.0, 0.0, FOCAL_LENGTH, y, 0.0, 0.0, 0.0, 1.0, 0.0]
        """,
        log="{msg.width} x {msg.height} pixels",
        checks=(
            "(message.width, message.height) == (640, 480)",
            "len(message.d) == 5",
            "message.k[8] == 1.0",
        ),
    ),
    "ChannelFloat32": Recipe(
        summary="the intensities of three points",
        code="""
            msg.name = 'intensity'
            msg.values = [abs(math.sin(self.count / 10.0 + index)) for index in range(3)]
        """,
        log="{msg.name} of {len(msg.values)} points",
        checks=("len(message.values) == 3",),
    ),
    "CompressedImage": Recipe(
        summary="a gray PNG image with a pattern that moves to the left",
        constants="""
            WIDTH = 64  # pixels
            HEIGHT = 48
        """,
        code="""
            row = bytes((column + self.count) * 4 % 256 for column in range(WIDTH))
            chunks = [
                (b'IHDR', struct.pack('>IIBBBBB', WIDTH, HEIGHT, 8, 0, 0, 0, 0)),  # 8 bits, gray
                (b'IDAT', zlib.compress(HEIGHT * (b'\\0' + row))),
                (b'IEND', b''),
            ]
            png = b'\\x89PNG\\r\\n\\x1a\\n'
            for kind, data in chunks:
                png += struct.pack('>I', len(data)) + kind + data
                png += struct.pack('>I', zlib.crc32(kind + data))
            msg.format = 'png'
            msg.data = png
        """,
        log="a {msg.format} image of {len(msg.data)} bytes",
        checks=("message.format == 'png'", "bytes(message.data[1:4]) == b'PNG'"),
    ),
    "FluidPressure": Recipe(
        summary="the pressure of the air",
        code="""
            msg.fluid_pressure = 101325.0 + 50.0 * math.sin(self.count / 10.0)  # pascals
            msg.variance = 4.0  # pascals squared
        """,
        log="{msg.fluid_pressure:.1f} Pa",
        checks=("101275.0 <= message.fluid_pressure <= 101375.0", "message.variance == 4.0"),
    ),
    "Illuminance": Recipe(
        summary="the light in a room",
        code="""
            msg.illuminance = 300.0 + 50.0 * math.sin(self.count / 10.0)  # lux
            msg.variance = 1.0  # lux squared
        """,
        log="{msg.illuminance:.1f} lux",
        checks=("250.0 <= message.illuminance <= 350.0", "message.variance == 1.0"),
    ),
    "Image": Recipe(
        summary="a gray image with a pattern that moves to the left",
        constants="""
            WIDTH = 64  # pixels
            HEIGHT = 48
        """,
        code="""
            msg.width = WIDTH
            msg.height = HEIGHT
            msg.encoding = 'mono8'  # one byte per pixel
            msg.step = WIDTH  # bytes per row
            row = bytes((column + self.count) * 4 % 256 for column in range(WIDTH))
            msg.data = HEIGHT * row
        """,
        log="{msg.width} x {msg.height} pixels, {msg.encoding}",
        checks=(
            "message.encoding == 'mono8'",
            "len(message.data) == message.height * message.step == 64 * 48",
        ),
    ),
    "Imu": Recipe(
        summary="the motion of a sensor that turns about the vertical axis",
        code="""
            seconds = msg.header.stamp.sec + msg.header.stamp.nanosec / 1e9
            angle = 0.2 * seconds  # radians
            msg.orientation.z = math.sin(angle / 2.0)
            msg.orientation.w = math.cos(angle / 2.0)
            msg.orientation_covariance[::4] = 1e-4  # the diagonal
            msg.angular_velocity.z = 0.2  # radians per second
            msg.angular_velocity_covariance[::4] = 1e-4
            msg.linear_acceleration.z = 9.81  # meters per second squared: gravity
            msg.linear_acceleration_covariance[::4] = 1e-2
        """,
        log="z {msg.orientation.z:.2f}, w {msg.orientation.w:.2f}",
        checks=(
            (
                "message.orientation.w == pytest.approx(\n"
                "    math.cos(0.1 * ("
                "message.header.stamp.sec + message.header.stamp.nanosec / 1e9)),\n"
                "    abs=1e-6)"
            ),
            "message.orientation.z**2 + message.orientation.w**2 == pytest.approx(1.0)",
            "message.linear_acceleration.z == 9.81",
            "message.orientation_covariance[0] > 0.0",
        ),
    ),
    "JointState": Recipe(
        summary="the state of two joints that swing",
        code="""
            msg.name = ['shoulder', 'elbow']
            seconds = msg.header.stamp.sec + msg.header.stamp.nanosec / 1e9
            angle = math.sin(0.2 * seconds)
            msg.position = [angle, -angle]  # radians
            velocity = 0.2 * math.cos(0.2 * seconds)
            msg.velocity = [velocity, -velocity]  # radians per second
            msg.effort = [0.5, 0.2]  # newton meters
        """,
        log="{msg.name[0]} {msg.position[0]:.2f} rad",
        checks=(
            "message.name == ['shoulder', 'elbow']",
            "len(message.position) == len(message.velocity) == len(message.effort) == 2",
            (
                "message.position[0] == pytest.approx(\n"
                "    math.sin(0.2 * ("
                "message.header.stamp.sec + message.header.stamp.nanosec / 1e9)),\n"
                "    abs=1e-6)"
            ),
            "message.position[0] == -message.position[1]",
            "math.hypot(message.position[0], 5.0 * message.velocity[0]) == pytest.approx(1.0)",
        ),
        frame="",
    ),
    "Joy": Recipe(
        summary="the axes and buttons of a gamepad in use",
        code="""
            wave = math.sin(self.count / 10.0)
            msg.axes = [wave, -wave, 0.0, 0.0]  # -1.0 to 1.0
            msg.buttons = [self.count % 2, 0, 0, 0]  # 1: pressed
        """,
        log="axes {msg.axes[0]:.2f} {msg.axes[1]:.2f}",
        checks=(
            "len(message.axes) == len(message.buttons) == 4",
            "message.axes[0] == -message.axes[1]",
            "-1.0 <= message.axes[0] <= 1.0",
            "message.buttons[0] in (0, 1)",
        ),
        frame="",
    ),
    "JoyFeedback": Recipe(
        summary="a rumble that swells and fades",
        code="""
            msg.type = JoyFeedback.TYPE_RUMBLE
            msg.intensity = 0.5 + 0.5 * math.sin(self.count / 10.0)  # 0.0 to 1.0
        """,
        log="{msg.intensity:.2f}",
        checks=("message.type == JoyFeedback.TYPE_RUMBLE", "0.0 <= message.intensity <= 1.0"),
    ),
    "JoyFeedbackArray": Recipe(
        summary="a rumble that swells and fades, and a light",
        code="""
            intensity = 0.5 + 0.5 * math.sin(self.count / 10.0)  # 0.0 to 1.0
            msg.array = [
                JoyFeedback(type=JoyFeedback.TYPE_RUMBLE, intensity=intensity),
                JoyFeedback(type=JoyFeedback.TYPE_LED, intensity=1.0),
            ]
        """,
        log="rumble {msg.array[0].intensity:.2f}",
        checks=("len(message.array) == 2",),
    ),
    "LaserEcho": Recipe(
        summary="three echoes of one ray of a laser",
        code="""
            distance = 2.0 + math.sin(self.count / 10.0)  # meters
            msg.echoes = [distance, distance + 0.5, distance + 1.0]
        """,
        log="{len(msg.echoes)} echoes, {msg.echoes[0]:.2f} m",
        checks=("len(message.echoes) == 3",),
    ),
    "LaserScan": Recipe(
        summary="a scan of a round room whose wall moves in and out",
        constants="RAYS = 360  # of one scan",
        code=f"""{_SCAN}
    distance = 2.0 + math.sin(self.count / 10.0)  # meters
    msg.ranges = [distance] * RAYS
    msg.intensities = [100.0] * RAYS
        """,
        log="{len(msg.ranges)} rays, {msg.ranges[0]:.2f} m",
        checks=(
            "len(message.ranges) == len(message.intensities) == 360",
            "all(1.0 <= distance <= 3.0 for distance in message.ranges)",
            "message.angle_min == pytest.approx(-math.pi)",
            "message.angle_max == pytest.approx(math.pi - message.angle_increment, abs=1e-4)",
            "message.angle_increment == pytest.approx(math.tau / 360)",
            "message.time_increment == pytest.approx(message.scan_time / 360)",
            "message.intensities[0] == 100.0",
        ),
    ),
    "MagneticField": Recipe(
        summary="the magnetic field of the earth, seen by a sensor that turns",
        code="""
            angle = self.count / 10.0  # radians
            msg.magnetic_field.x = 2e-5 * math.cos(angle)  # tesla
            msg.magnetic_field.y = -2e-5 * math.sin(angle)
            msg.magnetic_field.z = -4e-5
            msg.magnetic_field_covariance[::4] = 1e-12  # the diagonal
        """,
        log="x {msg.magnetic_field.x * 1e6:.1f} uT",
        checks=(
            "math.hypot(message.magnetic_field.x, message.magnetic_field.y) == pytest.approx(2e-5)",
            "message.magnetic_field.z == -4e-5",
            "message.magnetic_field_covariance[0] > 0.0",
        ),
    ),
    "MultiDOFJointState": Recipe(
        summary="the state of a joint that floats and circles",
        code="""
            seconds = msg.header.stamp.sec + msg.header.stamp.nanosec / 1e9
            angle = 0.2 * seconds  # radians
            transform = Transform()
            transform.translation.x = math.cos(angle)  # meters
            transform.translation.y = math.sin(angle)
            twist = Twist()
            twist.linear.x = -0.2 * math.sin(angle)  # meters per second
            twist.linear.y = 0.2 * math.cos(angle)
            msg.joint_names = ['base']
            msg.transforms = [transform]
            msg.twist = [twist]
            msg.wrench = [Wrench()]
        """,
        log="x {msg.transforms[0].translation.x:.2f} m",
        checks=(
            "message.joint_names == ['base']",
            "len(message.transforms) == len(message.twist) == len(message.wrench) == 1",
            (
                "message.transforms[0].translation.x == pytest.approx(\n"
                "    math.cos(0.2 * ("
                "message.header.stamp.sec + message.header.stamp.nanosec / 1e9)),\n"
                "    abs=1e-6)"
            ),
        ),
    ),
    "MultiEchoLaserScan": Recipe(
        summary="a scan of a round room with a window, two echoes for each ray",
        constants="RAYS = 360  # of one scan",
        code=f"""{_SCAN}
    distance = 2.0 + math.sin(self.count / 10.0)  # meters
    msg.ranges = [LaserEcho(echoes=[distance, distance + 1.0])] * RAYS
    msg.intensities = [LaserEcho(echoes=[100.0, 50.0])] * RAYS
        """,
        log="{len(msg.ranges)} rays",
        checks=("len(message.ranges) == len(message.intensities) == 360",),
    ),
    "NavSatFix": Recipe(
        summary="the position of a receiver that is carried around a place in Munich",
        code="""
            angle = self.count / 10.0  # radians
            msg.status.status = NavSatStatus.STATUS_FIX
            msg.status.service = NavSatStatus.SERVICE_GPS
            msg.latitude = 48.137 + 1e-4 * math.sin(angle)  # degrees
            msg.longitude = 11.575 + 1e-4 * math.cos(angle)
            msg.altitude = 520.0  # meters above the ellipsoid
            msg.position_covariance[::4] = 4.0  # the diagonal, meters squared
            msg.position_covariance_type = NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN
        """,
        log="{msg.latitude:.6f}, {msg.longitude:.6f}",
        checks=(
            "message.latitude == pytest.approx(48.137, abs=1e-3)",
            "message.longitude == pytest.approx(11.575, abs=1e-3)",
            "message.status.status == NavSatStatus.STATUS_FIX",
            "message.status.service == NavSatStatus.SERVICE_GPS",
            "list(message.position_covariance[::4]) == [4.0, 4.0, 4.0]",
            "message.position_covariance_type == NavSatFix.COVARIANCE_TYPE_DIAGONAL_KNOWN",
        ),
    ),
    "NavSatStatus": Recipe(
        summary="a fix that is lost and regained in turn",
        code="""
            has_fix = self.count % 2 == 0
            msg.status = NavSatStatus.STATUS_FIX if has_fix else NavSatStatus.STATUS_NO_FIX
            msg.service = NavSatStatus.SERVICE_GPS | NavSatStatus.SERVICE_GALILEO
        """,
        log="status {msg.status}",
        checks=("message.status in (NavSatStatus.STATUS_FIX, NavSatStatus.STATUS_NO_FIX)",),
    ),
    "PointCloud": Recipe(
        summary="a row of points that moves up and down, with intensities",
        code="""
            height = math.sin(self.count / 10.0)  # meters
            msg.points = [Point32(x=float(x), z=height) for x in range(10)]
            msg.channels = [ChannelFloat32(name='intensity', values=[1.0] * len(msg.points))]
        """,
        log="{len(msg.points)} points, z {msg.points[0].z:.2f} m",
        checks=("len(message.points) == len(message.channels[0].values) == 10",),
    ),
    "PointCloud2": Recipe(
        summary="a ring of points that moves up and down",
        constants="POINTS = 100",
        code="""
            height = math.sin(self.count / 10.0)  # meters
            angles = [2.0 * math.pi * index / POINTS for index in range(POINTS)]
            points = [(math.cos(angle), math.sin(angle), height) for angle in angles]
            msg = create_cloud_xyz32(msg.header, points)
        """,
        log="{msg.width} points, {len(msg.data)} bytes",
        checks=(
            "[field.name for field in message.fields] == ['x', 'y', 'z']",
            "(message.height, message.width) == (1, 100)",
            "len(message.data) == message.row_step == 100 * 12",
            "math.hypot(*struct.unpack('<ff', bytes(message.data[:8]))) == pytest.approx(1.0)",
        ),
    ),
    "PointField": Recipe(
        summary="the description of a coordinate in the data of a point: x, y and z in turn",
        code="""
            index = self.count % 3
            msg.name = 'xyz'[index]
            msg.offset = 4 * index  # bytes
            msg.datatype = PointField.FLOAT32
            msg.count = 1
        """,
        log="{msg.name} at byte {msg.offset}",
        checks=("message.name in ('x', 'y', 'z')", "message.datatype == PointField.FLOAT32"),
    ),
    "Range": Recipe(
        summary="the distance to an object that comes and goes",
        code="""
            msg.radiation_type = Range.ULTRASOUND
            msg.field_of_view = 0.5  # radians
            msg.min_range = 0.1  # meters
            msg.max_range = 4.0
            msg.range = 2.0 + math.sin(self.count / 10.0)
        """,
        log="{msg.range:.2f} m",
        checks=(
            "message.min_range < message.range < message.max_range",
            "message.radiation_type == Range.ULTRASOUND",
        ),
    ),
    "RegionOfInterest": Recipe(
        summary="a window of an image that moves to the right",
        code="""
            msg.x_offset = self.count % 320  # pixels
            msg.y_offset = 120
            msg.width = 320
            msg.height = 240
        """,
        log="{msg.width} x {msg.height} at x {msg.x_offset}",
        checks=("(message.width, message.height) == (320, 240)", "message.x_offset < 320"),
    ),
    "RelativeHumidity": Recipe(
        summary="the humidity of the air",
        code="""
            msg.relative_humidity = 0.5 + 0.1 * math.sin(self.count / 10.0)  # 0.0 to 1.0
            msg.variance = 0.0001
        """,
        log="{msg.relative_humidity:.1%}",
        checks=("0.4 <= message.relative_humidity <= 0.6",),
    ),
    "Temperature": Recipe(
        summary="the temperature of a room",
        code="""
            msg.temperature = 20.0 + 2.0 * math.sin(self.count / 10.0)  # degrees Celsius
            msg.variance = 0.01
        """,
        log="{msg.temperature:.2f} degrees Celsius",
        checks=("18.0 <= message.temperature <= 22.0",),
    ),
    "TimeReference": Recipe(
        summary="the time of another clock, here the same one",
        code="""
            msg.time_ref = self.get_clock().now().to_msg()
            msg.source = 'gps'
        """,
        log="{msg.time_ref.sec} s from {msg.source}",
        checks=("message.time_ref.sec > 0", "message.source == 'gps'"),
        frame="",
    ),
}
