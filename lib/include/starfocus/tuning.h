/* SPDX-License-Identifier: Apache-2.0 */
/* starfocus: what decides between time and error. Part of starfocus.h. */
#ifndef STARFOCUS_TUNING_H_
#define STARFOCUS_TUNING_H_

#include <stdint.h>

#define STARFOCUS_MAX_TIMING 100000000u
#define STARFOCUS_MIN_N_SCALE 0.5
#define STARFOCUS_MAX_N_SCALE 2.0

/** Run-time model of a block, the paper's (14) with terms for what surrounds the line scan, in
 *  picoseconds; only ratios matter. It decides the partition of STARFOCUS_MODE_BLOCK, and so its
 * bytes: starfocus_config_init sets the same coefficients on every machine, so that all of them
 * give the same picture. Those that `starfocus-lab calibrate` measures on a machine save it little
 * (0.4 % of the work where it was counted), and its pictures then differ from those of other
 * machines. */
typedef struct starfocus_timing {
  uint32_t block;    /**< per block */
  uint32_t field;    /**< per pixel of the extended block at its layer: loading, rotating */
  uint32_t a;        /**< k_A: per rendered pixel of type A, extended along the other axis */
  uint32_t b;        /**< k_B: per rendered pixel of type B */
  uint32_t c;        /**< k_C: per rendered pixel of type C */
  uint32_t upsample; /**< per picture pixel of a block at layer 1 or 2 */
  uint32_t span;     /**< per stretch of one disparity in a rendered line, one a line at least */
  uint32_t hole;     /**< per pixel that a depth edge uncovers in the outermost view, 8 at most */
} starfocus_timing;

/** What decides between time and error, or is there for tests. starfocus_config_init sets the
 * defaults. */
typedef struct starfocus_tuning {
  int32_t
      max_layer; /**< largest subsampled layer L of STARFOCUS_MODE_BLOCK: 0, 1 or 2; default 2 */
  int32_t deblocking; /**< beta of (16), (17) in gray levels, [0, 255]; 0: off; default 35 */
  int32_t gather; /**< 1, the default: by STARFOCUS_RENDERER_SLICES STARFOCUS_MODE_BLOCK blurs the
                     centre view itself, with the kernel (4), where one surface is all that lies
                     within reach; 0: it renders views there too */
  double
      n_scale; /**< time against error: multiplies the N of either renderer in STARFOCUS_MODE_BLOCK
                  and STARFOCUS_MODE_FRAME, rounded up; the number of views grows with its square;
                    [STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE]; default 1 */
  starfocus_timing timing; /**< each coefficient <= STARFOCUS_MAX_TIMING */
} starfocus_tuning;

#endif /* STARFOCUS_TUNING_H_ */
