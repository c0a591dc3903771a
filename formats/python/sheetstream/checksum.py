# SPDX-License-Identifier: MIT
"""XXH3 with 64 bits and without a seed, which every part of a stream is checked with (formats/sheet.md).

By the module xxhash where there is one, else by numpy, at 0.1 GB a second. Source: the algorithm's
specification, github.com/Cyan4973/xxHash/blob/dev/doc/xxhash_spec.md. Inputs of 1 to 16 bytes, which a stream never
has, are left out.

>>> hex(checksum(b"")), hex(checksum(bytes(64)))
('0x2d06800538d394c2', '0x2ffb6918c12c256e')
"""
from __future__ import annotations

from typing import Any, Union

import numpy as np
import numpy.typing as npt

Buffer = Union[bytes, bytearray, memoryview]

_MASK = (1 << 64) - 1
_PRIME32 = (0x9E3779B1, 0x85EBCA77, 0xC2B2AE3D)
_PRIME64 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5)
_SECRET = bytes.fromhex(
    "b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221"
    "b8084674f743248ee03590e6813a264c3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8"
    "a8fa763fe39c343ff9dcbbc7c70b4f1d8a51e04bcdb45931c89f7ec9d9787364eac5ac8334d3ebc3c581a0fffa1363eb"
    "170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e")
_START = np.array([_PRIME32[2], *_PRIME64[:4], _PRIME32[1], _PRIME64[4], _PRIME32[0]], np.uint64)
_STRIPE, _STRIPES_A_BLOCK = 64, (len(_SECRET) - 64) // 8


def _word(data: Buffer, at: int) -> int:
    return int.from_bytes(data[at:at + 8], "little")


def _folded_product(a: int, b: int) -> int:
    product = a * b
    return (product & _MASK) ^ (product >> 64)


def _avalanche(h: int) -> int:
    h ^= h >> 37
    h = h * 0x165667919E3779F9 & _MASK
    return h ^ h >> 32


def _mix(data: Buffer, at: int, secret: int) -> int:
    return _folded_product(_word(data, at) ^ _word(_SECRET, secret), _word(data, at + 8) ^ _word(_SECRET, secret + 8))


def _of_up_to_128(data: Buffer) -> int:
    size = len(data)
    total = size * _PRIME64[0]
    for i in range((size - 1) // 32, -1, -1):
        total += _mix(data, 16 * i, 32 * i) + _mix(data, size - 16 * (i + 1), 32 * i + 16)
    return _avalanche(total & _MASK)


def _of_up_to_240(data: Buffer) -> int:
    total = len(data) * _PRIME64[0] + sum(_mix(data, 16 * i, 16 * i) for i in range(8))
    total = _avalanche(total & _MASK)
    total += sum(_mix(data, 16 * i, 16 * (i - 8) + 3) for i in range(8, len(data) // 16))
    return _avalanche((total + _mix(data, len(data) - 16, 136 - 17)) & _MASK)


def _secret_words(at: int) -> npt.NDArray[Any]:
    return np.frombuffer(_SECRET[at:at + _STRIPE], "<u8")


def _stripe_sums(stripes: npt.NDArray[Any], secret: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """What stripes (..., 8) add to the eight sums, with the secret that belongs to each."""
    keyed = stripes ^ secret
    product = (keyed & np.uint64(0xFFFFFFFF)) * (keyed >> np.uint64(32))
    return np.asarray(product + stripes.reshape(*stripes.shape[:-1], 4, 2)[..., ::-1].reshape(stripes.shape))


def _of_more(data: Buffer) -> int:
    size = len(data)
    count = (size - 1) // _STRIPE
    stripes = np.frombuffer(data, "<u8", 8 * count).reshape(count, 8)
    secrets = np.stack([_secret_words(8 * i) for i in range(_STRIPES_A_BLOCK)])
    blocks = count // _STRIPES_A_BLOCK
    sums, last_secret = _START.copy(), _secret_words(len(_SECRET) - _STRIPE)
    whole = blocks * _STRIPES_A_BLOCK
    for first in range(0, whole, 1024 * _STRIPES_A_BLOCK):  # bounds the memory
        part = stripes[first:min(first + 1024 * _STRIPES_A_BLOCK, whole)].reshape(-1, _STRIPES_A_BLOCK, 8)
        for block in _stripe_sums(part, secrets).sum(axis=1, dtype=np.uint64):
            sums += block
            sums = (sums ^ sums >> np.uint64(47) ^ last_secret) * np.uint64(_PRIME32[0])
    rest = stripes[whole:]
    sums += _stripe_sums(rest, secrets[:len(rest)]).sum(axis=0, dtype=np.uint64)
    end = np.frombuffer(data[size - _STRIPE:], "<u8")
    sums += _stripe_sums(end, _secret_words(len(_SECRET) - _STRIPE - 7))
    total = size * _PRIME64[0]
    for i in range(4):
        total += _folded_product(int(sums[2 * i]) ^ _word(_SECRET, 11 + 16 * i),
                                 int(sums[2 * i + 1]) ^ _word(_SECRET, 19 + 16 * i))
    return _avalanche(total & _MASK)


def numpy_checksum(data: Buffer) -> int:
    """The checksum of bytes, without the module xxhash."""
    size = len(data)
    if size == 0:
        h = _word(_SECRET, 56) ^ _word(_SECRET, 64)
        h = (h ^ h >> 33) * _PRIME64[1] & _MASK
        h = (h ^ h >> 29) * _PRIME64[2] & _MASK
        return h ^ h >> 32
    if size <= 16:
        raise ValueError("checksums of 1 to 16 bytes are left out")
    return _of_up_to_128(data) if size <= 128 else _of_up_to_240(data) if size <= 240 else _of_more(data)


try:
    import xxhash
except ImportError:
    checksum = numpy_checksum
else:
    def checksum(data: Buffer) -> int:
        """The checksum of bytes."""
        return int(xxhash.xxh3_64_intdigest(data))
