/* SPDX-License-Identifier: Apache-2.0 */
/* Fields of starfocus_config, starfocus_params and starfocus_lens by their C names, for JavaScript,
 * which sees no structures. */
#ifndef STARFOCUS_PLATFORM_WEB_SRC_FIELDS_H_
#define STARFOCUS_PLATFORM_WEB_SRC_FIELDS_H_

#include "starfocus/starfocus.h"

/* Writes a number into the field of that name, such as "max_blur" or "timing.block". Whole numbers
 * that the field cannot hold become the nearest that it can. Returns 1, or 0 when there is no such
 * field. */
int SetConfigField(starfocus_config* config, const char* name, double value);
int SetParamsField(starfocus_params* params, const char* name, double value);

#endif /* STARFOCUS_PLATFORM_WEB_SRC_FIELDS_H_ */
