#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes the corpus anew, byte for byte the same: formats/corpus/make.py [FOLDER]

passed/NNNN_name.sheet must be accepted, its text form is NNNN_name.txt.
failed/NNNN_name.sheet must be refused; NNNN_name.txt holds the message (without the file's name) and the exit code.
"""
import io
import pathlib
import struct
import sys

import numpy as np
import xxhash

folder = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(folder.parent / "python"))
import sheetstream  # noqa: E402
from sheetstream import Array, Frame  # noqa: E402


def triangle_frame(**more):
    """One triangle; `more` arrays behind the required ones."""
    arrays = {
        "position": Array(np.array([[0, 0, 0], [1, 0, 0], [0, 0.5, 0]], "f8"), "vertex", "m", "interpolate"),
        "triangle": Array(np.array([[0, 1, 2]], "u4"), "triangle", "1", "drop"),
        "volume": Array(np.array([0.001]), "triangle", "m^3", "conserve"),
    }
    return Frame(0.0, 0, arrays | more)


def empty_frame():
    frame = triangle_frame()
    for array in frame.arrays.values():
        array.values = array.values[:0]
    return frame


def stream(*frames):
    file = io.BytesIO()
    writer = sheetstream.Writer(file)
    for frame in frames:
        writer.write(frame)
    writer.end()
    return file.getvalue()


def text_array(text):
    return Array(text, "frame")


def integers(kind, place="vertex", transfer="copy", rows=3):
    info = np.iinfo(kind)
    return Array(np.array([info.min, info.max, 1][:rows], kind), place, "1", transfer)


def bits(kind, numbers):
    return np.array(numbers, f"u{kind[1:]}").view(kind)


# Forging: change bytes and make the checksums right again.


def checksum(data):
    return struct.pack("<Q", xxhash.xxh3_64_intdigest(bytes(data)))


def forge(data, *patches):
    """Patches (byte, new bytes) of a stream that starts with a frame; then the checksums of payloads, table, header."""
    data = bytearray(data)
    arrays, = struct.unpack_from("<I", data, 64)
    spans = [struct.unpack_from("<QQ", data, 128 * (i + 1) + 88) for i in range(arrays)]
    for at, new in patches:
        data[at:at + len(new)] = new
    for i, (offset, size) in enumerate(spans):
        data[128 * (i + 1) + 104:128 * (i + 1) + 112] = checksum(data[offset:offset + (size + 63) // 64 * 64])
    data[72:80] = checksum(data[128:128 * (arrays + 1)])
    data[120:128] = checksum(data[:120])
    return bytes(data)


def forge_end(data, at, new):
    """Patches the END mark at the end of the stream."""
    mark = bytearray(data[-64:])
    mark[at:at + len(new)] = new
    mark[56:] = checksum(mark[:56])
    return data[:-64] + bytes(mark)


def flip(data, at):
    return data[:at] + bytes([data[at] ^ 1]) + data[at + 1:]


def u(value, size=8):
    return value.to_bytes(size, "little")


one = stream(triangle_frame())
note = stream(triangle_frame(note=text_array("water")))
entry = {name: 128 * (i + 1) for i, name in enumerate(("position", "triangle", "volume", "note"))}
position_at, triangle_at, volume_at = (struct.unpack_from("<Q", one, entry[name] + 88)[0] for name in list(entry)[:3])
note_at, = struct.unpack_from("<Q", note, entry["note"] + 88)


def with_value(name, index, value):
    frame = triangle_frame()
    frame[name].flat[index] = value
    return stream(frame)


def with_array(name, array):
    return stream(triangle_frame(**{name: array}))


def without(name):
    frame = triangle_frame()
    del frame.arrays[name]
    return stream(frame)


def hard_numbers():
    double = [0x3fb999999999999a, 0x8000000000000000, 1, 0x000fffffffffffff, 0x7fefffffffffffff, 0x7ff0000000000000,
              0xfff0000000000000, 0x7ff8000000000000, 0xfff8000000000000, 0x7ff0000000000001, 0xffffffffffffffff,
              0x3d30000000000000, 0x4341c37937e08000, 0x430c6bf526340000, 0x3f1a36e2eb1c432d, 0x3ee4f8b588e368f1]
    single = [0x3dcccccd, 0x80000000, 1, 0x007fffff, 0x7f7fffff, 0x7f800000, 0xff800000, 0x7fc00000, 0xffc00000,
              0x7f800001, 0xffffffff, 0x4b800000, 0x5a0e1bca, 0x38d1b717, 0x3727c5ac, 0x58635fa9]
    return triangle_frame(double=Array(bits("f8", double), "frame", "1", "interpolate"),
                          single=Array(bits("f4", single).reshape(4, 4), "frame", "kg", "conserve"))


def random_numbers():
    """Any bits, and powers of two: shortest decimals on both sides of each."""
    double = [xxhash.xxh3_64_intdigest(u(i)) for i in range(200)] + [i << 52 for i in range(1, 0x7ff, 11)]
    single = [xxhash.xxh3_64_intdigest(u(i)) >> 32 for i in range(200)] + [i << 23 for i in range(1, 0xff, 3)]
    return triangle_frame(double=Array(bits("f8", double), "frame"), single=Array(bits("f4", single), "frame"))


def all_types():
    kinds = ("int8", "uint8", "int32", "uint32", "int64", "uint64")
    return triangle_frame(**{kind: integers(kind, "vertex", ("copy", "common", "drop")[i % 3])
                             for i, kind in enumerate(kinds)},
                          float32=Array(np.array([0.5], "f4"), "triangle", "K", "conserve"),
                          float64=Array(np.array([[1.5, -2.5]]), "triangle", "1/s", "interpolate"),
                          text=text_array("text"), none=Array(np.zeros((0, 7)), "frame", "1", "drop"))


def standard_arrays():
    frame = triangle_frame(
        velocity=Array(np.full((3, 3), -0.25), "vertex", "m/s", "interpolate"),
        start_position=Array(np.zeros((3, 3)), "vertex", "m", "drop"),
        hold=Array(np.array([1, 0, 1 << 63], "u8"), "vertex", "1", "common"),
        next_output_time=Array(np.array([0.25]), "frame", "s", "copy"),
        step_size=Array(np.array([0.125]), "frame", "s", "copy"),
        scene=text_array('[sheet]\nshape = "disk"\n'))
    frame.time, frame.step = 0.125, 1
    frame.record("sheet-init (0.1.0)")
    frame.record("sheet-step (0.1.0) --tolerance 0.001")
    frame.record("sheet-step (0.1.0) --tolerance 0.001")
    return frame


def contacts(vertex=2, rests=2, **more):
    one = np.array([[1.0, -0.5, -0.25, -0.25]] * 2)
    return triangle_frame(
        touch=Array(np.array([0, 0, 2], "u8"), "vertex", "1", "common"),
        contact_vertex=Array(np.array([[0, 1, 2, 2], [1, vertex, 0, 0]], "u4"), "frame", "1", "drop"),
        contact_weight=Array(one, "frame", "1", "drop"),
        contact_normal=Array(np.array([[0, 0, 1.0], [0, 1.0, 0]]), "frame", "1", "drop"),
        contact_rest=Array(np.full(rests, 0.125), "frame", "m", "drop"),
        contact_anchor=Array(np.zeros((2, 3)), "frame", "m", "drop"),
        contact_stiffness=Array(np.array([[1.5, 0.5], [1.5, 0]]), "frame", "N/m", "drop"), **more)


def dated_contacts(*dates):
    return contacts(contact_since=Array(np.array(dates, "f8"), "frame", "s", "drop"))


def drops(volumes=(1.5e-9, 4e-9), **more):
    return triangle_frame(
        drop_position=Array(np.array([[0.25, 0.5, -1], [0.5, 0, 2]]), "frame", "m", "copy"),
        drop_velocity=Array(np.array([[0, -1.5, 0], [0, 0, 0]]), "frame", "m/s", "copy"),
        drop_volume=Array(np.array(volumes), "frame", "m^3", "copy"),
        drop_touch=Array(np.array([0, 1], "u4"), "frame", "1", "copy"), **more)


def inlet():
    return triangle_frame(inlet=Array(np.array([0, 3, 3], "u8"), "vertex", "1", "common"),
                          inlet_origin=Array(np.array([[0, 0, 0], [1, 0, 0], [0, 0.5, 0]], "f8"), "vertex", "m",
                                             "interpolate"))


def extreme_header():
    frame = empty_frame()
    frame.time, frame.step = -0.0, (1 << 64) - 1
    return frame


texts = {"empty": "", "newline": "\n", "lines": "a\n\n# b\n| c\nend\n", "utf-8": "\u00e4\u20ac\U0001f4a7\r\n\t\x7f"}
edges = Array(np.array([0.5, 0.25, 2.0]), "edge", "J", "drop")
newer = forge(one, (10, u(1, 2)), (68, u(7, 4)), (80, b"reserved"), (entry["volume"] + 112, b"reserved"))

passed = {
    "no_frames": stream(),
    "no_triangles": stream(empty_frame()),
    "one_triangle": one,
    "two_frames": stream(triangle_frame(), empty_frame()),
    "standard_arrays": stream(standard_arrays()),
    "all_types": stream(all_types()),
    "hard_numbers": stream(hard_numbers()),
    "random_numbers": stream(random_numbers()),
    "texts": stream(triangle_frame(**{name: text_array(text) for name, text in texts.items()})),
    "edges": with_array("energy", edges),
    "extreme_header": stream(extreme_header()),
    "long_names": with_array("0123456789_abcdefghijklmnopqrstuvwxyz.:-2345678",
                             Array(np.ones(3), "vertex", "kg*m^2/(s^3*A)!~{x}[y]", "drop")),
    "many_arrays": stream(triangle_frame(**{f"n{i}": text_array("") for i in range(100)})),
    "critical_standard": with_array("hold", Array(np.zeros(3, "u8"), "vertex", "1", "common", critical=True)),
    "joined": one + one,
    "joined_empty": stream() + stream(empty_frame()) + stream() + stream() + one + stream(),
    "newer_minor": forge_end(forge_end(newer, 10, u(1, 2)), 24, b"reserved"),
    "contacts": stream(contacts()),
    "inlet": stream(inlet()),
    "swept_volume": stream(triangle_frame(swept_volume=Array(np.array([1e-9, -2e-9, 0], "f8"), "vertex", "m^3",
                                                             "conserve"))),
    "touch_force": stream(triangle_frame(touch=Array(np.array([1, 1, 0], "u8"), "vertex", "1", "common"),
                                         touch_force=Array(np.array([[0, 0.5, 0], [0.25, -0.125, 0], [0, 0, 0]], "f8"),
                                                           "vertex", "N", "conserve"))),
    "start_time": stream(triangle_frame(start_position=Array(np.zeros((3, 3)), "vertex", "m", "drop"),
                                        start_time=Array(np.array([-0.125]), "frame", "s", "copy"))),
    "director_angle": with_array("director_angle", Array(np.array([0, -0.125, 3.0]), "edge", "rad", "drop")),
    "touch_wide": with_array("touch", Array(np.array([[0, 1], [0, 0], [2, 0]], "u8"), "vertex", "1", "common")),
    "touch_overshoot": with_array("touch_overshoot", Array(np.array([[0, 0, 0], [0, -0.0625, 0], [0, 0, 0]], "f8"),
                                                           "vertex",
                                                           "m", "interpolate")),
    "health": with_array("health", Array(np.array([[1, 40, 0.25, 0.5, 0.001953125, 0.5, 0.125, 12, 1, 0.5, 0, -0.25],
                                                   [5, 3, 0.5, 0.5, 0.0009765625, 0.5, 0, 0, 0, 0, 0, 0]]), "frame",
                                                   "1", "copy")),
    "contact_since": stream(dated_contacts(0.25, -np.inf)),
    "temperature": stream(triangle_frame(temperature=Array(np.array([1173.15]), "triangle", "K", "mean"),
                                         temperature_rate=Array(np.array([-12.5]), "triangle", "K/s", "mean"),
                                         temperature_mode=Array(np.array([[0.5, -8.25]]), "triangle", "K", "mean"),
                                         temperature_mode_rate=Array(np.array([[0, 0.125]]), "triangle", "K/s",
                                                                     "mean"))),
    "drops": stream(drops(drop_start_position=Array(np.zeros((2, 3)), "frame", "m", "drop"))),
    "touch_overshoot_time": with_array("touch_overshoot_time", Array(np.array([0, 0.125, 0], "f8"), "vertex", "s",
                                                                     "interpolate")),
    "solid_force": with_array("solid_force", Array(np.array([[0, 0.5, 0], [0.25, -0.125, 0]], "f8"), "frame", "N",
                                                   "copy")),
}

failed = {
    "empty": b"",
    "no_end": one[:-64],
    "cut_in_magic": one[:5],
    "cut_in_second_magic": stream(triangle_frame(), triangle_frame())[:len(one) - 64 + 7],
    "cut_in_header": one[:100],
    "cut_in_header_first_half": one[:50],
    "cut_in_table": one[:300],
    "cut_in_payload": one[:position_at + 10],
    "cut_in_padding": one[:volume_at + 10],
    "cut_in_end": one[:-1],
    "other_format": b"solid cube\n" * 20,
    "zstd": b"\x28\xb5\x2f\xfd" + bytes(100),
    "text_form": b"sheet-text 1.0\nend\n",
    "rubbish_behind_end": one + b"x",
    "header_checksum": flip(one, 48),
    "table_checksum": flip(one, entry["volume"] + 3),
    "payload_checksum": flip(one, position_at),
    "padding_checksum": flip(one, volume_at + 63),
    "end_checksum": flip(one, len(one) - 30),
    "end_of_joined_checksum": flip(one, len(one) - 1) + one,
    "major_version": forge(one, (8, u(2, 2))),
    "critical_flags": forge(one, (12, u(4, 4))),
    "reserved_in_header": forge(one, (68, u(1, 4))),
    "reserved_behind_header": forge(one, (119, b"\1")),
    "frame_length_not_padded": forge(one, (16, u(len(one) - 65))),
    "frame_length_below_table": forge(one, (16, u(128))),
    "frame_length_above_limit": forge(one, (16, u((1 << 48) + 64))),
    "frame_length_above_arrays": forge(one, (16, u(len(one)))),
    "too_many_vertices": forge(one, (24, u((1 << 32) + 1))),
    "too_many_edges": forge(one, (40, u(1 << 40))),
    "time_not_finite": forge(one, (48, struct.pack("<d", float("nan")))),
    "too_many_arrays": forge(one, (64, u(4097, 4)), (16, u(128 * 4098))),
    "most_arrays_never_come": forge(one, (64, u(4096, 4)), (16, u(128 * 4097))),
    "name_does_not_end": forge(one, (entry["volume"], b"v" * 48)),
    "name_goes_on": forge(one, (entry["volume"] + 40, b"x")),
    "name_empty": forge(one, (entry["volume"], bytes(6))),
    "name_capital": forge(one, (entry["volume"], b"V")),
    "name_raw_bytes": forge(one, (entry["volume"], b"\x1b[2J\xff\n")),
    "name_twice": forge(note, (entry["note"], b"volume")),
    "unit_does_not_end": forge(one, (entry["volume"] + 48, b"m" * 24)),
    "unit_empty": forge(one, (entry["volume"] + 48, bytes(3))),
    "unit_blank": forge(one, (entry["volume"] + 48, b"m 3")),
    "place_unknown": forge(one, (entry["volume"] + 72, b"\4")),
    "type_unknown": forge(one, (entry["volume"] + 73, b"\12")),
    "type_zero": forge(one, (entry["volume"] + 73, b"\0")),
    "rule_unknown": forge(one, (entry["volume"] + 74, b"\6")),
    "flags_unknown": forge(one, (entry["volume"] + 75, b"\3")),
    "flags_unknown_newer_minor": forge(one, (10, u(1, 2)), (entry["volume"] + 75, b"\2")),
    "no_components": forge(note, (entry["note"] + 76, u(0, 4)), (entry["note"] + 80, u(1 << 60)),
                           (entry["note"] + 96, u(0)), (16, u(len(note) - 128))),
    "rows_not_of_place": forge(one, (24, u(4))),
    "bytes_not_rows": forge(one, (entry["volume"] + 96, u(16))),
    "bytes_overflow": forge(note, (entry["note"] + 73, b"\x08"), (entry["note"] + 76, u(1 << 31, 4)),
                            (entry["note"] + 80, u(1 << 30)), (entry["note"] + 96, u(0))),
    "bytes_beyond_frame": forge(note, (entry["note"] + 80, u(1 << 40)), (entry["note"] + 96, u(1 << 40))),
    "offset_overlaps": forge(one, (entry["volume"] + 88, u(triangle_at - 128))),
    "offset_leaves_gap": forge(one, (entry["volume"] + 88, u(volume_at + 64))),
    "entry_reserved": forge(one, (entry["volume"] + 127, b"\1")),
    "text_at_vertex": forge(note, (entry["note"] + 72, b"\0")),
    "common_of_float": forge(one, (entry["volume"] + 74, b"\4")),
    "conserve_of_integer": forge(one, (entry["triangle"] + 74, b"\3")),
    "interpolate_of_text": forge(note, (entry["note"] + 74, b"\2")),
    "critical_unknown": forge(note, (entry["note"] + 75, b"\1")),
    "edges_without_array": forge(one, (40, u(3))),
    "huge_payload_never_comes": forge(note, (entry["note"] + 80, u(1 << 40)), (entry["note"] + 96, u(1 << 40)),
                                      (16, u(note_at + (1 << 40)))),
    "padding_not_zero": forge(one, (triangle_at + 20, b"\1")),
    "text_with_zero": forge(note, (note_at + 2, b"\0")),
    "text_not_utf_8": forge(note, (note_at + 3, b"\xc3")),
    "text_overlong": forge(note, (note_at, b"\xc0\xaf")),
    "text_surrogate": forge(note, (note_at, b"\xed\xa0\x80")),
    "end_major_version": forge_end(one, 8, u(2, 2)),
    "end_critical_flags": forge_end(one, 12, u(1, 4)),
    "end_reserved": forge_end(one, 55, b"\1"),
    "end_counts_wrong": forge_end(one, 16, u(2)),
    "end_of_joined_counts_all": one + forge_end(one, 16, u(2)),
    "position_missing": without("position"),
    "volume_missing": without("volume"),
    "position_nan": with_value("position", 4, float("nan")),
    "position_infinite": with_value("position", 8, float("-inf")),
    "triangle_out_of_range": with_value("triangle", 1, 3),
    "triangle_degenerate": with_value("triangle", 2, 0),
    "volume_zero": with_value("volume", 0, 0),
    "volume_negative": with_value("volume", 0, -1.5e-7),
    "volume_infinite": with_value("volume", 0, float("inf")),
    "velocity_single": with_array("velocity", Array(np.zeros((3, 3), "f4"), "vertex", "m/s", "interpolate")),
    "velocity_unit": with_array("velocity", Array(np.zeros((3, 3)), "vertex", "km/h", "interpolate")),
    "velocity_rule": with_array("velocity", Array(np.zeros((3, 3)), "vertex", "m/s", "copy")),
    "start_position_nan": with_array("start_position", Array(np.full((3, 3), np.nan), "vertex", "m", "drop")),
    "hold_place": with_array("hold", Array(np.zeros(1, "u8"), "triangle", "1", "common")),
    "step_size_zero": with_array("step_size", Array(np.zeros(1), "frame", "s", "copy")),
    "step_size_rows": with_array("step_size", Array(np.ones(2), "frame", "s", "copy")),
    "next_output_time_nan": with_array("next_output_time", Array(np.full(1, np.nan), "frame", "s", "copy")),
    "scene_not_text": with_array("scene", Array(np.zeros(1, "u1"), "frame")),
    "edges_miscounted": with_array("energy", Array(np.zeros(4), "edge", "J", "drop")),
    "second_frame_volume": stream(triangle_frame(), *sheetstream.read(io.BytesIO(with_value("volume", 0, -1)), None,
                                                                      False)),
    "contact_out_of_range": stream(contacts(vertex=3)),
    "contact_rows": stream(contacts(rests=1)),
    "contact_alone": with_array("contact_vertex", Array(np.zeros((1, 4), "u4"), "frame", "1", "drop")),
    "touch_rule": with_array("touch", Array(np.zeros(3, "u8"), "vertex", "1", "copy")),
    "inlet_place": with_array("inlet", Array(np.zeros(1, "u8"), "triangle", "1", "common")),
    "inlet_origin_nan": with_array("inlet_origin", Array(np.full((3, 3), np.nan), "vertex", "m", "interpolate")),
    "swept_volume_nan": with_array("swept_volume", Array(np.full(3, np.nan), "vertex", "m^3", "conserve")),
    "touch_force_nan": with_array("touch_force", Array(np.full((3, 3), np.nan), "vertex", "N", "conserve")),
    "touch_force_rule": with_array("touch_force", Array(np.zeros((3, 3)), "vertex", "N", "interpolate")),
    "start_time_infinite": with_array("start_time", Array(np.array([np.inf]), "frame", "s", "copy")),
    "start_time_rows": with_array("start_time", Array(np.zeros(2), "frame", "s", "copy")),
    "director_angle_nan": with_array("director_angle", Array(np.full(3, np.nan), "edge", "rad", "drop")),
    "director_angle_place": with_array("director_angle", Array(np.zeros(3), "vertex", "rad", "drop")),
    "touch_overshoot_nan": with_array("touch_overshoot", Array(np.full((3, 3), np.nan), "vertex", "m", "interpolate")),
    "health_nan": with_array("health", Array(np.full((1, 12), np.nan), "frame", "1", "copy")),
    "contact_since_infinite": stream(dated_contacts(0.25, np.inf)),
    "contact_since_rows": stream(dated_contacts(0.25)),
    "mean_of_vertex": forge(one, (entry["position"] + 74, b"\5")),
    "mean_of_integer": forge(one, (entry["triangle"] + 74, b"\5")),
    "temperature_zero": with_array("temperature", Array(np.zeros(1), "triangle", "K", "mean")),
    "temperature_nan": with_array("temperature", Array(np.full(1, np.nan), "triangle", "K", "mean")),
    "temperature_rule": with_array("temperature", Array(np.full(1, 300.0), "triangle", "K", "interpolate")),
    "temperature_place": with_array("temperature", Array(np.full(3, 300.0), "vertex", "K", "interpolate")),
    "temperature_rate_infinite": with_array("temperature_rate", Array(np.full(1, np.inf), "triangle", "K/s", "mean")),
    "drop_volume_zero": stream(drops(volumes=(1e-9, 0.0))),
    "drop_rows": stream(drops(volumes=(1e-9,))),
    "drop_alone": with_array("drop_volume", Array(np.full(2, 1e-9), "frame", "m^3", "copy")),
    "drop_liquid_type": stream(drops(drop_liquid=Array(np.zeros(2, "i4"), "frame", "1", "copy"))),
    "gzip": b"\x1f\x8b\x08\0" + bytes(100),
    "xz": b"\xfd7zXZ\0" + bytes(100),
    "bzip2": b"BZh9" + bytes(100),
    "bytes_of_no_kind": bytes(range(100)),
}


def text_form(data):
    reader = sheetstream.Reader(io.BytesIO(data), check_values=False)
    lines, ends = ["sheet-text 1.0\n"], 0
    for frame in reader:
        lines.append("end\n" * (reader.ends - ends) + sheetstream.text(frame))
        ends = reader.ends
    return "".join(lines) + "end\n" * (reader.ends - ends)


def refusal(data):
    try:
        for _ in sheetstream.read(io.BytesIO(data), "file"):
            pass
    except sheetstream.StreamError as error:
        return f"{str(error).removeprefix('file: ')}\nexit code {error.exit_code}\n"
    raise ValueError("a stream that must be refused is not")


def main():
    target = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else folder)
    for kind, streams, twin in (("passed", passed, text_form), ("failed", failed, refusal)):
        place = target / "1.0" / kind
        place.mkdir(parents=True, exist_ok=True)
        for i, (name, data) in enumerate(streams.items(), start=1):
            (place / f"{i:04}_{name}.sheet").write_bytes(data)
            (place / f"{i:04}_{name}.txt").write_bytes(twin(data).encode())


main()
