# SPDX-License-Identifier: Apache-2.0
"""Pictures for tests of the import: grey JPEGs made without any library, tagged by exiftool."""
import json
import shutil
import struct
import subprocess

EXIFTOOL = shutil.which("exiftool")


def grey_jpeg(width, height):
    """A baseline JPEG of that size. Each block of 8 x 8 is two bits: no change of its mean, and no detail."""
    def segment(marker, body):
        return bytes([0xFF, marker]) + struct.pack(">H", len(body) + 2) + body
    one_code = bytes([1] + [0] * 15 + [0])  # one code of one bit, 0, for the value 0
    frame = struct.pack(">BHHB", 8, height, width, 1) + bytes([1, 0x11, 0])
    blocks = ((width + 7) // 8) * ((height + 7) // 8)
    scan = bytes(2 * blocks // 8) + (bytes([(1 << (8 - 2 * blocks % 8)) - 1]) if 2 * blocks % 8 else b"")
    return (b"\xff\xd8" + segment(0xDB, bytes(1) + bytes([1] * 64)) + segment(0xC0, frame) +
            segment(0xC4, b"\x00" + one_code) + segment(0xC4, b"\x10" + one_code) +
            segment(0xDA, bytes([1, 1, 0, 0, 63, 0])) + scan + b"\xff\xd9")


def write_tags(folder, tags_by_name):
    """Writes the tags, exiftool's names with their groups, into the pictures of a folder."""
    tables = [{"SourceFile": str(folder / name), **tags} for name, tags in tags_by_name.items()]
    (folder / "tags.json").write_text(json.dumps(tables))
    subprocess.run([EXIFTOOL, "-q", "-n", "-overwrite_original", f"-json={folder / 'tags.json'}",
                    *(folder / name for name in tags_by_name)], check=True, capture_output=True)
    (folder / "tags.json").unlink()


def read_tags(*files):
    """What exiftool reads, as numbers where it can: a dictionary a file."""
    done = subprocess.run([EXIFTOOL, "-json", "-n", *files], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def dji_tags(**changes):
    """Tags as DJI's cameras write them; a change to None leaves one out."""
    tags = {"EXIF:Make": "DJI", "EXIF:Model": "FC300S", "EXIF:DateTimeOriginal": "2016:06:23 16:32:43",
            "EXIF:SubSecTimeOriginal": "125", "EXIF:OffsetTimeOriginal": "+02:00", "EXIF:FocalLengthIn35mmFormat": 20,
            "EXIF:GPSLatitude": 46.842864, "EXIF:GPSLatitudeRef": "N", "EXIF:GPSLongitude": 91.993697,
            "EXIF:GPSLongitudeRef": "W", "EXIF:GPSAltitude": 198.41, "EXIF:GPSAltitudeRef": 0,
            "XMP-drone-dji:AbsoluteAltitude": 198.41, "XMP-drone-dji:RelativeAltitude": 39.9,
            "XMP-drone-dji:GimbalRollDegree": 0, "XMP-drone-dji:GimbalPitchDegree": -60.5,
            "XMP-drone-dji:GimbalYawDegree": -140, "XMP-drone-dji:FlightRollDegree": -4,
            "XMP-drone-dji:FlightPitchDegree": -0.1, "XMP-drone-dji:FlightYawDegree": -138.7}
    for name, value in changes.items():
        group = next((key.split(":")[0] for key in tags if key.split(":")[1] == name), "EXIF")
        tags[f"{group}:{name}"] = value
    return {key: value for key, value in tags.items() if value is not None}
