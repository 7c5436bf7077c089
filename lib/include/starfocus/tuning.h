/* SPDX-License-Identifier: Apache-2.0 */
/** @file
 * Trade-offs between time and error. Part of starfocus.h. */
#ifndef STARFOCUS_TUNING_H_
#define STARFOCUS_TUNING_H_

#include <stdint.h>

/** Largest coefficient of starfocus_timing. */
#define STARFOCUS_MAX_TIMING 100000000u
/** Smallest starfocus_tuning.n_scale. */
#define STARFOCUS_MIN_N_SCALE 0.5
/** Largest starfocus_tuning.n_scale. */
#define STARFOCUS_MAX_N_SCALE 2.0

/** Model of the time that a block takes: equation (14) of the paper, with additional terms for the
 *  work around the line scan. Coefficients are in picoseconds; only their ratios matter. The model
 *  determines how STARFOCUS_MODE_BLOCK splits superblocks, and therefore affects the output bytes.
 *  starfocus_config_init sets the same coefficients on every machine, so that all machines compute
 *  the same picture. Coefficients that were fitted to single boards saved at most 0.4 % of the
 *  instructions (docs/boards.md). */
typedef struct starfocus_timing {
  uint32_t block; /**< Picoseconds per block. */
  uint32_t field; /**< Picoseconds per pixel of the block with its border, at the layer of the
                     block, for loading and rotating. */
  uint32_t a; /**< k_A of (14), picoseconds per rendered pixel of type A (views on the axes), with
                 the border of the other axis. */
  uint32_t
      b; /**< k_B of (14), picoseconds per rendered pixel of type B (views on the diagonals). */
  uint32_t c; /**< k_C of (14), picoseconds per rendered pixel of type C (all other views). */
  uint32_t upsample; /**< Picoseconds per pixel of the picture in a block at layer 1 or 2. */
  uint32_t span; /**< Picoseconds per run of equal disparity in a rendered line; a line counts as at
                    least one run. */
  uint32_t hole; /**< Picoseconds per pixel that depth edges uncover in the outermost view, at most
                    8 pixels for each edge. */
} starfocus_timing;

/** Trade-offs between time and error. starfocus_config_init sets the defaults. */
typedef struct starfocus_tuning {
  int32_t max_layer;  /**< Largest layer L of STARFOCUS_MODE_BLOCK, [0, 2]; default 2. */
  int32_t deblocking; /**< Limit beta of deblocking, (16) and (17), in codes, [0, 255]; 0: off;
                         default 35. */
  /** If 1, STARFOCUS_MODE_BLOCK with slices gathers the pixels of smooth surfaces, which means that
   *  the centre view is blurred by the point-spread function (4). If 0, STARFOCUS_MODE_BLOCK
   *  renders views for all pixels. Default 1. */
  int32_t gather;
  /** STARFOCUS_MODE_BLOCK and STARFOCUS_MODE_FRAME multiply N, the number of views along the
   *  radius, by this factor and round the product up. The number of views grows with the square of
   *  the factor. Range [STARFOCUS_MIN_N_SCALE, STARFOCUS_MAX_N_SCALE]; default 1. */
  double n_scale;
  starfocus_timing timing; /**< Each coefficient <= STARFOCUS_MAX_TIMING. */
} starfocus_tuning;

#endif /* STARFOCUS_TUNING_H_ */
