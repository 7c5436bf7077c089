/* SPDX-License-Identifier: Apache-2.0 */
/* A plugin of QEMU's user emulators. The plugin counts the executed instructions of all functions,
 * or only of functions whose symbol contains one of the given texts. Unlike a measured time, the
 * count does not depend on the load of the machine.
 *
 *   qemu-aarch64 -plugin count_instructions.so,sym=TEXT,sym=TEXT -d plugin PROGRAM
 *
 * prints "instructions: N" on stderr when PROGRAM ends. Debian has no header for version 1 of the
 * plugin interface, so this file declares the functions that it uses. */
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 = 0 };

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id,
                                           void (*translated)(qemu_plugin_id_t id,
                                                              struct qemu_plugin_tb* block));
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id,
                                    void (*ended)(qemu_plugin_id_t id, void* data), void* data);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* block);
struct qemu_plugin_insn* qemu_plugin_tb_get_insn(const struct qemu_plugin_tb* block, size_t index);
const char* qemu_plugin_insn_symbol(const struct qemu_plugin_insn* instruction);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn* instruction,
                                                enum qemu_plugin_op op, void* counter,
                                                uint64_t operand);
void qemu_plugin_outs(const char* text);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

enum { kMostTexts = 16 };
static char texts[kMostTexts][64];
static int text_count;
static uint64_t instructions;

static int Wanted(const char* symbol) {
  if (text_count == 0) return 1;
  if (symbol == NULL) return 0;
  for (int i = 0; i < text_count; ++i) {
    if (strstr(symbol, texts[i]) != NULL) return 1;
  }
  return 0;
}

static void Translated(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
  (void)id;
  for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); ++i) {
    struct qemu_plugin_insn* instruction = qemu_plugin_tb_get_insn(block, i);
    if (!Wanted(qemu_plugin_insn_symbol(instruction))) continue;
    qemu_plugin_register_vcpu_insn_exec_inline(instruction, QEMU_PLUGIN_INLINE_ADD_U64,
                                               &instructions, 1);
  }
}

static void Ended(qemu_plugin_id_t id, void* data) {
  char line[64];
  (void)id, (void)data;
  snprintf(line, sizeof(line), "instructions: %" PRIu64 "\n", instructions);
  qemu_plugin_outs(line);
}

__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t id,
                                                               const void* info, int argc,
                                                               char** argv) {
  (void)info;
  for (int i = 0; i < argc; ++i) {
    if (strncmp(argv[i], "sym=", 4) != 0 || text_count == kMostTexts) return -1;
    snprintf(texts[text_count++], sizeof(texts[0]), "%s", argv[i] + 4);
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, Translated);
  qemu_plugin_register_atexit_cb(id, Ended, NULL);
  return 0;
}
