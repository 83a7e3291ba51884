/* atlas_packet.h: the state of a vehicle as a packet of atlas_cueing, version 1.
 *
 * One file, C99, nothing but the standard library; include it where it is used. The layout and the
 * meaning of each field are in packets.py beside this file. Send the 128 bytes by UDP, 10 to 1000
 * times a second:
 *
 *     atlas_packet state = {0};
 *     uint8_t bytes[ATLAS_PACKET_BYTES];
 *     state.session = ...;              random, another one each time the program starts
 *     for each step:
 *         state.sequence += 1;
 *         state.time = ...; state.attitude ...; state.rate ...; state.force ...;
 *         atlas_packet_write(bytes, &state, NULL, 0);
 *         sendto(socket, bytes, sizeof bytes, ...);
 */
#ifndef ATLAS_PACKET_H
#define ATLAS_PACKET_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#define ATLAS_PACKET_BYTES 128
#define ATLAS_PACKET_SHORTEST_KEY 16
#define ATLAS_PACKET_LONGEST_KEY 64

typedef struct {
    uint64_t session;   /* random, another one each time the sender starts */
    uint64_t sequence;  /* strictly increasing within a session */
    double time;        /* of the simulation, s */
    int euler;          /* 0: attitude is a quaternion; 1: it is roll, pitch, heading */
    double attitude[4]; /* w, x, y, z: body to local north-east-down; or rad, rad, rad, 0 */
    double rate[3];     /* body rates p, q, r, forward-right-down, rad/s */
    double force[3];    /* specific force at the eye, forward-right-down, m/s^2; (0, 0, -9.80665) at rest */
} atlas_packet;

static inline void atlas_put_u64(uint8_t *at, uint64_t value) {
    for (int k = 0; k < 8; k++) at[k] = (uint8_t)(value >> (8 * k));
}

static inline void atlas_put_double(uint8_t *at, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    atlas_put_u64(at, bits);
}

/* CRC-32 of zlib, PNG and Ethernet: polynomial 0x04c11db7, reflected. */
static inline uint32_t atlas_crc32(const uint8_t *data, size_t size) {
    uint32_t crc = 0xffffffffu;
    for (size_t k = 0; k < size; k++) {
        crc ^= data[k];
        for (int bit = 0; bit < 8; bit++) crc = (crc >> 1) ^ (0xedb88320u & (0u - (crc & 1u)));
    }
    return ~crc;
}

/* One block of 64 bytes of SHA-256 (FIPS 180-4, 6.2.2). */
static inline void atlas_sha256_block(uint32_t state[8], const uint8_t block[64]) {
    static const uint32_t K[64] = {
        0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
        0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
        0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
        0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
        0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
        0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
        0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
        0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};
#define ATLAS_ROTATED(x, n) (((x) >> (n)) | ((x) << (32 - (n))))
    uint32_t w[64], v[8];
    for (int t = 0; t < 16; t++)
        w[t] = (uint32_t)block[4 * t] << 24 | (uint32_t)block[4 * t + 1] << 16
               | (uint32_t)block[4 * t + 2] << 8 | block[4 * t + 3];
    for (int t = 16; t < 64; t++) {
        uint32_t a = w[t - 15], b = w[t - 2];
        w[t] = (ATLAS_ROTATED(b, 17) ^ ATLAS_ROTATED(b, 19) ^ (b >> 10)) + w[t - 7]
               + (ATLAS_ROTATED(a, 7) ^ ATLAS_ROTATED(a, 18) ^ (a >> 3)) + w[t - 16];
    }
    memcpy(v, state, sizeof v);
    for (int t = 0; t < 64; t++) {
        uint32_t a = v[0], e = v[4];
        uint32_t one = v[7] + (ATLAS_ROTATED(e, 6) ^ ATLAS_ROTATED(e, 11) ^ ATLAS_ROTATED(e, 25))
                       + ((e & v[5]) ^ (~e & v[6])) + K[t] + w[t];
        uint32_t two = (ATLAS_ROTATED(a, 2) ^ ATLAS_ROTATED(a, 13) ^ ATLAS_ROTATED(a, 22))
                       + ((a & v[1]) ^ (a & v[2]) ^ (v[1] & v[2]));
        memmove(v + 1, v, 7 * sizeof v[0]);
        v[4] += one;
        v[0] = one + two;
    }
    for (int k = 0; k < 8; k++) state[k] += v[k];
#undef ATLAS_ROTATED
}

/* SHA-256 of a block of 64 bytes and what follows it, at most 112 bytes. */
static inline void atlas_sha256(uint8_t digest[32], const uint8_t block[64], const uint8_t *data, size_t size) {
    uint32_t state[8] = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    uint8_t rest[128] = {0};
    size_t end = size + 9 <= 64 ? 64 : 128;
    uint64_t bits = 8 * (64 + (uint64_t)size);
    atlas_sha256_block(state, block);
    memcpy(rest, data, size);
    rest[size] = 0x80;
    for (int k = 0; k < 8; k++) rest[end - 1 - (size_t)k] = (uint8_t)(bits >> (8 * k));
    for (size_t at = 0; at < end; at += 64) atlas_sha256_block(state, rest + at);
    for (int k = 0; k < 32; k++) digest[k] = (uint8_t)(state[k / 4] >> (24 - 8 * (k % 4)));
}

/* HMAC-SHA-256 (RFC 2104) with a key of at most 64 bytes, of at most 112 bytes. */
static inline void atlas_hmac(uint8_t digest[32], const uint8_t *key, size_t key_size,
                              const uint8_t *data, size_t size) {
    uint8_t inner[64] = {0}, outer[64], first[32];
    memcpy(inner, key, key_size);
    for (int k = 0; k < 64; k++) {
        outer[k] = inner[k] ^ 0x5c;
        inner[k] ^= 0x36;
    }
    atlas_sha256(first, inner, data, size);
    atlas_sha256(digest, outer, first, sizeof first);
}

/* Writes the packet. key: shared with the receiver, 16 to 64 bytes; NULL and 0 for none.
 * Returns ATLAS_PACKET_BYTES, or 0 for a key of another size (nothing is written). */
static inline size_t atlas_packet_write(uint8_t bytes[ATLAS_PACKET_BYTES], const atlas_packet *packet,
                                        const uint8_t *key, size_t key_size) {
    uint8_t digest[32] = {0};
    const size_t content = ATLAS_PACKET_BYTES - 16;
    if (key_size && (key_size < ATLAS_PACKET_SHORTEST_KEY || key_size > ATLAS_PACKET_LONGEST_KEY)) return 0;
    memcpy(bytes, "ATVP", 4);
    bytes[4] = 1;
    bytes[5] = key_size ? 1 : 0;
    bytes[6] = packet->euler ? 1 : 0;
    bytes[7] = 0;
    atlas_put_u64(bytes + 8, packet->session);
    atlas_put_u64(bytes + 16, packet->sequence);
    atlas_put_double(bytes + 24, packet->time);
    for (int k = 0; k < 4; k++) atlas_put_double(bytes + 32 + 8 * k, packet->attitude[k]);
    for (int k = 0; k < 3; k++) atlas_put_double(bytes + 64 + 8 * k, packet->rate[k]);
    for (int k = 0; k < 3; k++) atlas_put_double(bytes + 88 + 8 * k, packet->force[k]);
    if (key_size) {
        atlas_hmac(digest, key, key_size, bytes, content);
    } else {
        uint32_t crc = atlas_crc32(bytes, content);
        for (int k = 0; k < 4; k++) digest[k] = (uint8_t)(crc >> (8 * k));
    }
    memcpy(bytes + content, digest, 16);
    return ATLAS_PACKET_BYTES;
}

#endif
