/* SPDX-License-Identifier: Apache-2.0 */
/* Sets fields of starfocus_config, starfocus_params and starfocus_lens by their C names. Used by
 * bridge.c, because JavaScript has no access to the layout of C structures. */
#ifndef STARFOCUS_PLATFORM_WEB_SRC_FIELDS_H_
#define STARFOCUS_PLATFORM_WEB_SRC_FIELDS_H_

#include "starfocus/starfocus.h"

/* Sets the field `name`, for example "max_blur" or "timing.block", to `value`. If `value` does not
 * fit an integer field, the field gets a value that the library rejects. Returns 1, or 0 if the
 * structure has no field `name`. */
int SetConfigField(starfocus_config* config, const char* name, double value);
int SetParamsField(starfocus_params* params, const char* name, double value);

#endif /* STARFOCUS_PLATFORM_WEB_SRC_FIELDS_H_ */
