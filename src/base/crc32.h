/* CRC-32 as zlib, Ethernet and PNG have it: polynomial 0x04c11db7 read from its low end, start and end inverted. The
 * CRC of nothing is 0, that of "123456789" is 0xcbf43926. [ANY, pure] */
#ifndef BASE_CRC32_H
#define BASE_CRC32_H

#include <stddef.h>
#include <stdint.h>

/* The CRC of all bytes so far, given that of those before these. Two table look-ups a byte. */
uint32_t crc32_add(uint32_t crc, const uint8_t *bytes, size_t size);

#endif
