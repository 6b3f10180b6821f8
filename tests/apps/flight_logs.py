# SPDX-License-Identifier: Apache-2.0
"""Logs for tests of the import, written from a flight's MAVLink telemetry as autopilots and cameras write them."""
import datetime
import math
import struct

HEARTBEAT, GPS, ATTITUDE, POSITION, MOUNT, GIMBAL = 0, 24, 30, 33, 265, 285
GPS_EPOCH_S, LEAP_SECONDS = 315964800, 18
LATENCY_US = 120_000  # what geoloc_sim's stamps are late by


def read_tlog(file):
    """(UNIX us, message number, payload) of each MAVLink 2 frame."""
    log, at = file.read_bytes(), 0
    while at < len(log):
        size, number = log[at + 9], int.from_bytes(log[at + 15:at + 18], "little")
        yield struct.unpack_from(">Q", log, at)[0], number, log[at + 18:at + 18 + size].ljust(255, b"\0")
        at += 8 + 12 + size


class Flight:
    """States of a vehicle by its own clock, and what UTC is ahead of that."""

    def __init__(self, tlog):
        self.attitudes, self.positions, self.fixes, self.gimbal = [], [], [], []
        for stamp_us, number, payload in read_tlog(tlog):
            if number == ATTITUDE:
                boot_ms, roll, pitch, yaw = struct.unpack_from("<Ifff", payload)
                self.attitudes.append((boot_ms * 1000, roll, pitch, yaw))
                self.utc_us = stamp_us - boot_ms * 1000
            elif number == POSITION:
                boot_ms, lat, lon, alt, above_home, vn, ve, vd = struct.unpack_from("<Iiiiihhh", payload)
                self.positions.append((boot_ms * 1000, lat / 1e7, lon / 1e7, alt / 1e3, above_home / 1e3,
                                       (vn / 100, ve / 100, vd / 100)))
            elif number == GPS:
                boot_us, lat, lon, alt = struct.unpack_from("<Qiii", payload)
                h_acc_mm, v_acc_mm = struct.unpack_from("<II", payload, 34)
                self.fixes.append((boot_us, lat / 1e7, lon / 1e7, alt / 1e3, payload[28], h_acc_mm / 1e3, v_acc_mm / 1e3))
            elif number == GIMBAL:
                boot_ms, *turn = struct.unpack_from("<I4f", payload)
                self.gimbal.append((boot_ms * 1000, *map(math.degrees, euler_angles(*turn))))

    def begin_us(self):
        return min(self.attitudes[0][0], self.positions[0][0])


SIZES = {"Q": "Q", "i": "i", "B": "B", "H": "H", "I": "I", "c": "h", "C": "H", "L": "i", "f": "f", "e": "i", "n": "4s", "N": "16s",
         "Z": "64s"}
SCALES = {"c": 100, "C": 100, "e": 100, "L": 1e7}


class Dataflash:
    """Writes records that FMT records describe."""

    def __init__(self):
        self.bytes, self.formats = bytearray(), {}
        self.define("FMT", "BBnNZ", "Type,Length,Name,Format,Columns", number=128)

    def define(self, name, types, columns, number=None):
        number = number or 128 + len(self.formats)
        size = 3 + struct.calcsize("<" + "".join(SIZES[kind] for kind in types))
        self.formats[name] = number, types
        self.bytes += b"\xa3\x95\x80" + struct.pack("<BB4s16s64s", number, size, name.encode(), types.encode(),
                                                    columns.encode())

    def add(self, name, *values):
        number, types = self.formats[name]
        scaled = [round(value * SCALES[kind]) if kind in SCALES else value for kind, value in zip(types, values)]
        self.bytes += b"\xa3\x95" + bytes([number]) + struct.pack("<" + "".join(SIZES[kind] for kind in types), *scaled)


def to_dataflash(flight, video_starts_us=(), gimbal=()):
    """As ArduPilot 4.5 writes it. Angles are hundredths of a degree there."""
    log = Dataflash()
    log.define("ATT", "QccccCCCCB", "TimeUS,DesRoll,Roll,DesPitch,Pitch,DesYaw,Yaw,ErrRP,ErrYaw,AEKF")
    log.define("POS", "QLLfff", "TimeUS,Lat,Lng,Alt,RelHomeAlt,RelOriginAlt")
    log.define("GPS", "QBBIHBcLLeffffB", "TimeUS,I,Status,GMS,GWk,NSats,HDop,Lat,Lng,Alt,Spd,GCrs,VZ,Yaw,U")
    log.define("GPA", "QBCCCC", "TimeUS,I,VDop,HAcc,VAcc,SAcc")
    log.define("XKF1", "QBccCfff", "TimeUS,C,Roll,Pitch,Yaw,VN,VE,VD")
    log.define("MAVC", "QBBBBBHffffiifBB", "TimeUS,TS,TC,SS,SC,Fr,Cmd,P1,P2,P3,P4,X,Y,Z,Res,WL")
    log.define("MNT", "QBfffffffff", "TimeUS,I,DRoll,Roll,DPitch,Pitch,DYawB,YawB,DYawE,YawE,Dist")
    events = [(time, "ATT", (0, math.degrees(roll), 0, math.degrees(pitch), 0, math.degrees(yaw) % 360, 0, 0, 3))
              for time, roll, pitch, yaw in flight.attitudes]
    for time, lat, lon, alt, above_home, velocity in flight.positions:
        events.append((time, "POS", (lat, lon, alt, above_home, above_home)))
        events.append((time, "XKF1", (0, 0, 0, 0, *velocity)))
    for time, lat, lon, alt, status, h_acc_m, v_acc_m in flight.fixes:
        gps_ms = (time + flight.utc_us) // 1000 - GPS_EPOCH_S * 1000 + LEAP_SECONDS * 1000
        week, within_ms = divmod(gps_ms, 7 * 86400 * 1000)
        events.append((time, "GPS", (0, status, within_ms, week, 12, 0.8, lat, lon, alt, 0, 0, 0, 0, 1)))
        events.append((time, "GPA", (0, 1.2, h_acc_m, v_acc_m, 0.1)))
    for time, roll_deg, pitch_deg, yaw_deg in gimbal:
        events.append((time, "MNT", (0, 0, roll_deg, 0, pitch_deg, 0, 0, 0, yaw_deg, 0)))
    for time in video_starts_us:
        events.append((time, "MAVC", (1, 100, 255, 190, 0, 2500, 0, 0, 0, 0, 0, 0, 0, 0, 0)))
    for time, name, values in sorted(events, key=lambda event: event[0]):
        log.add(name, time, *values)
    return bytes(log.bytes)


class Ulog:
    """Writes messages of ULog."""

    def __init__(self, begin_us):
        self.bytes, self.topics = bytearray(b"ULog\x01\x12\x35\x01" + struct.pack("<Q", begin_us)), {}
        self.add("B", bytes(40))

    def add(self, kind, body):
        self.bytes += struct.pack("<Hc", len(body), kind.encode()) + body

    def define(self, name, form, fields):
        self.add("F", f"{name}:{fields};".encode())
        self.topics[name] = len(self.topics), form

    def subscribe(self):
        for name, (number, _) in self.topics.items():
            self.add("A", struct.pack("<BH", 0, number) + name.encode())

    def sample(self, name, *values):
        number, form = self.topics[name]
        self.add("D", struct.pack("<H", number) + struct.pack("<" + form, *values))


def quaternion(roll, pitch, yaw):
    """w, x, y, z of the turn from the body to north, east, down."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(angle / 2), math.sin(angle / 2)) for angle in (roll, pitch, yaw))
    return (cr * cp * cy + sr * sp * sy, sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy)


def euler_angles(w, x, y, z):
    """Roll, pitch, yaw of such a turn."""
    return (math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)), math.asin(max(-1, min(1, 2 * (w * y - z * x)))),
            math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))


def to_ulog(flight, video_starts_us=(), gimbal=()):
    """As PX4 1.14 writes it; heights count from the sea, and home tells its own."""
    log = Ulog(flight.begin_us())
    log.define("vehicle_attitude", "QQ4f", "uint64_t timestamp;uint64_t timestamp_sample;float[4] q")
    log.define("vehicle_global_position", "QQddf",
               "uint64_t timestamp;uint64_t timestamp_sample;double lat;double lon;float alt")
    log.define("vehicle_local_position", "QQfff", "uint64_t timestamp;uint64_t timestamp_sample;float vx;float vy;float vz")
    log.define("vehicle_gps_position", "QQddddffB", "uint64_t timestamp;uint64_t time_utc_usec;double latitude_deg;"
               "double longitude_deg;double altitude_msl_m;double altitude_ellipsoid_m;float eph;float epv;uint8_t fix_type")
    log.define("home_position", "QddfB", "uint64_t timestamp;double lat;double lon;float alt;bool valid_alt")
    log.define("vehicle_command", "QI", "uint64_t timestamp;uint32_t command")
    log.define("gimbal_device_attitude_status", "Q4fH", "uint64_t timestamp;float[4] q;uint16_t device_flags")
    log.subscribe()
    events = [(time, "vehicle_attitude", (time, *quaternion(roll, pitch, yaw)))
              for time, roll, pitch, yaw in flight.attitudes]
    for time, lat, lon, alt, _, velocity in flight.positions:
        events.append((time, "vehicle_global_position", (time, lat, lon, alt)))
        events.append((time, "vehicle_local_position", (time, *velocity)))
    for time, lat, lon, alt, fix_type, *accuracies_m in flight.fixes:
        events.append((time, "vehicle_gps_position", (time + flight.utc_us, lat, lon, alt, alt, *accuracies_m, fix_type)))
    for time, *angles_deg in gimbal:
        events.append((time, "gimbal_device_attitude_status", (*quaternion(*map(math.radians, angles_deg)), 64)))
    time, lat, lon, alt, above_home, _ = flight.positions[0]
    events.append((flight.begin_us(), "home_position", (lat, lon, alt - above_home, 1)))
    for time in video_starts_us:
        events.append((time, "vehicle_command", (2500,)))
    for time, name, values in sorted(events, key=lambda event: event[0]):
        log.sample(name, time, *values)
    return bytes(log.bytes)


def at(samples, time_us):
    """Straight between the samples around; angles, the last three of attitudes, without jumps of a turn."""
    after = next((i for i, sample in enumerate(samples) if sample[0] >= time_us), len(samples) - 1)
    first, second = samples[max(after - 1, 0)], samples[after]
    share = (time_us - first[0]) / (second[0] - first[0]) if second[0] > first[0] else 0.0
    between = []
    for a, b in zip(first[1:], second[1:]):
        if isinstance(a, tuple):
            continue
        step = math.remainder(b - a, math.tau) if len(first) == 4 else b - a
        between.append(a + share * step)
    return between


def turned(axis, angle):
    cosine, sine = math.cos(angle), math.sin(angle)
    return {"x": [[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]], "y": [[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]],
            "z": [[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]]}[axis]


def product(*matrices):
    result = matrices[0]
    for other in matrices[1:]:
        result = [[sum(row[k] * other[k][j] for k in range(3)) for j in range(3)] for row in result]
    return result


def camera_below(flight, time_us):
    """Roll, pitch, yaw in degrees of a camera that looks down from the vehicle, against north, east, down."""
    roll, pitch, yaw = at(flight.attitudes, time_us)
    turn = product(turned("z", yaw), turned("y", pitch), turned("x", roll), turned("y", -math.pi / 2))
    return [math.degrees(angle) for angle in (math.atan2(turn[2][1], turn[2][2]), -math.asin(max(-1, min(1, turn[2][0]))),
                                              math.atan2(turn[1][0], turn[0][0]))]


def clock(duration_s):
    whole_ms = int(duration_s * 1000)
    return f"{whole_ms // 3600000:02}:{whole_ms // 60000 % 60:02}:{whole_ms // 1000 % 60:02},{whole_ms % 1000:03}"


def to_srt(flight, frames_us, gimbal_deg=None, focal_35mm_mm=24):
    """As DJI's newer models write it, one subtitle a frame: what was when it was exposed. frames_us are times of the
    vehicle's clock. `gimbal_deg` tells roll, pitch, yaw of the camera at a time."""
    blocks = []
    for number, time_us in enumerate(frames_us, 1):
        lat, lon, alt, above_home = at(flight.positions, time_us)[:4]
        begin_s = (time_us - frames_us[0]) / 1e6
        date = datetime.datetime.fromtimestamp((time_us + flight.utc_us) / 1e6, datetime.timezone.utc)
        gimbal = ""
        if gimbal_deg:
            roll, pitch, yaw = gimbal_deg(time_us)
            gimbal = f" [gb_yaw: {yaw:.1f} gb_pitch: {pitch:.1f} gb_roll: {roll:.1f}]"
        blocks.append(f"{number}\n{clock(begin_s)} --> {clock(begin_s + 0.1)}\n<font size=\"28\">FrameCnt: {number}, "
                      f"DiffTime: 100ms\n{date:%Y-%m-%d %H:%M:%S}.{date.microsecond // 1000:03}\n[iso: 100] "
                      f"[focal_len: {focal_35mm_mm:.2f}] [latitude: {lat:.6f}] [longitude: {lon:.6f}] [rel_alt: {above_home:.3f} "
                      f"abs_alt: {alt:.3f}]{gimbal} </font>\n")
    return "\n".join(blocks)


def to_table(flight):
    """Attitudes and positions in lines of their own, by UTC; accuracies are those of the fix before."""
    rows = [(time, "", "", "", "", "", *(f"{math.degrees(angle):.7f}" for angle in angles)) for time, *angles in flight.attitudes]
    for time, lat, lon, alt, above_home, _ in flight.positions:
        accuracy_m = [fix[5] for fix in flight.fixes if fix[0] <= time or fix is flight.fixes[0]][-1]
        rows.append((time, f"{lat:.7f}", f"{lon:.7f}", f"{above_home:.3f}", f"{alt:.3f}", accuracy_m, "", "", ""))
    lines = ["utc,lat,lon,height_above_home_m,alt_msl_m,sigma_horizontal_m,roll_deg,pitch_deg,yaw_deg"]
    for time, *cells in sorted(rows, key=lambda row: row[0]):
        utc = datetime.datetime.fromtimestamp((time + flight.utc_us) / 1e6, datetime.timezone.utc)
        lines.append(",".join([utc.strftime("%Y-%m-%dT%H:%M:%S.%fZ"), *map(str, cells)]))
    return "\n".join(lines) + "\n"


def labels_of(frames):
    """The detections of a recording's frames, as labels of the video beside it."""
    lines = ["picture,u,v,width,height,confidence"]
    for number, frame in enumerate(frames):
        boxes = [(*detection["box"], detection["confidence"]) for detection in frame["detections"]]
        lines += [f"{number},{x + w / 2 - 0.5},{y + h / 2 - 0.5},{w},{h},{confidence}" for x, y, w, h, confidence in boxes]
        lines += [] if boxes else [f"{number},,,,,"]
    return "\n".join(lines) + "\n"
