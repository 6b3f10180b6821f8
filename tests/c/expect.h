/* SPDX-License-Identifier: Apache-2.0 */
#ifndef GEOLOC_TESTS_C_EXPECT_H
#define GEOLOC_TESTS_C_EXPECT_H

#include <geoloc/geoloc.h>

#include <stdio.h>
#include <string.h>

static int failures = 0;

#define EXPECT(condition)                                     \
  do {                                                        \
    if (!(condition)) {                                       \
      printf("line %d: not %s\n", __LINE__, #condition);      \
      ++failures;                                             \
    }                                                         \
  } while (0)

/* The call fails with that status, and the reason names `word`. */
#define EXPECT_REFUSED(call, status, word)                                                                   \
  do {                                                                                                       \
    const geoloc_status answer = (call);                                                                     \
    if (answer != (status) || strstr(geoloc_last_error(), (word)) == NULL) {                                 \
      printf("line %d: %s answers %d, \"%s\"\n", __LINE__, #call, (int)answer, geoloc_last_error());         \
      ++failures;                                                                                            \
    }                                                                                                        \
  } while (0)
#define EXPECT_INVALID(call, word) EXPECT_REFUSED(call, GEOLOC_INVALID_ARGUMENT, word)
#define EXPECT_NO_SETTING(call, word) EXPECT_REFUSED(call, GEOLOC_INVALID_SETTING, word)

#endif
