/* Requests that only look: who, what there is, and how it stands. */
#include "base/compiler.h"
#include "model/presets.h"
#include "protocol/commands.h"
#include "protocol/link_parts.h"
#include "protocol/signals.h"

enum link_progress link_hello(struct link *link)
{
    const struct identity *identity = link->identity;
    struct bytes_writer *reply = &link->reply;

    if (bytes_get_u8(&link->arguments) != LINK_MAJOR) {
        return link_refuse(link, &(struct link_refusal){.error = ERROR_WRONG_VERSION, .expected = LINK_MAJOR});
    }
    if (!link_end_study(link)) {
        return LINK_WAITS;
    }
    link->steps.has_last = false;
    bytes_put_u8(reply, LINK_MAJOR);
    bytes_put_u8(reply, LINK_MINOR);
    bytes_put_u16(reply, PARAMS_VERSION);
    bytes_put_u16(reply, SIGNALS_VERSION);
    bytes_put_u16(reply, COMMANDS_VERSION);
    bytes_put_u8(reply, (uint8_t)params_count);
    bytes_put_u8(reply, SIGNAL_COUNT);
    bytes_put_u8(reply, (uint8_t)presets_count);
    bytes_put_u8(reply,
                 (uint8_t)((identity->is_emulated ? LINK_IS_EMULATED : 0) | (identity->has_fpu ? LINK_HAS_FPU : 0)));
    bytes_put_u16(reply, FRAME_PAYLOAD_MAX);
    bytes_put_text(reply, identity->version, LINK_VERSION_WIDTH);
    bytes_put_text(reply, identity->build, LINK_BUILD_WIDTH);
    bytes_put_text(reply, identity->board, LINK_BOARD_WIDTH);
    bytes_put_text(reply, identity->core, LINK_CORE_WIDTH);
    return link_answer(link);
}

enum link_progress link_ping(struct link *link)
{
    bytes_put_u64(&link->reply, bytes_get_u64(&link->arguments));
    return link_answer(link);
}

struct row {
    unsigned id;
    uint8_t kind, change;
    float standard, low, high;
    const char *symbol, *unit, *help;
};

static struct row param_row(const struct params_info *info)
{
    const bool is_choice = params_is_choice(info);

    return (struct row){.id = info->id,
                        .kind = is_choice               ? LINK_CHOICE
                                : params_is_whole(info) ? LINK_WHOLE
                                                        : LINK_REAL,
                        .change = info->change == PARAMS_LIVE ? LINK_LIVE : LINK_RESTART,
                        .standard = info->standard,
                        .low = info->low,
                        .high = info->high,
                        .symbol = info->symbol,
                        .unit = info->unit,
                        .help = info->help};
}

static uint8_t signal_kind(enum signal_form form)
{
    switch (form) {
    case SIGNAL_FORM_COUNT:
    case SIGNAL_FORM_MODE:
    case SIGNAL_FORM_PROPENSITY:
    case SIGNAL_FORM_WATCH:
        return LINK_WHOLE;
    case SIGNAL_FORM_BITS:
        return LINK_BITS;
    case SIGNAL_FORM_TIME:
    case SIGNAL_FORM_REAL:
    default:
        return LINK_REAL;
    }
}

static struct row row_of(unsigned table, unsigned index)
{
    if (table == LINK_PARAMS) {
        return param_row(&params_table[index]);
    }
    if (table == LINK_SIGNALS) {
        const struct signal_info *info = &signals_table[index];

        return (struct row){.id = index,
                            .kind = signal_kind(info->form),
                            .change = LINK_READ_ONLY,
                            .symbol = info->name,
                            .unit = info->unit,
                            .help = info->help};
    }
    return (struct row){.id = index,
                        .change = LINK_READ_ONLY,
                        .symbol = table == LINK_PRESETS ? presets_table[index].name : selftest_table[index].name,
                        .unit = "",
                        .help = table == LINK_PRESETS ? presets_table[index].help : selftest_table[index].help};
}

enum link_progress link_dictionary(struct link *link)
{
    const size_t counts[LINK_TABLE_COUNT] = {params_count, SIGNAL_COUNT, presets_count, SELFTEST_COUNT};
    const uint8_t table = bytes_get_u8(&link->arguments);
    const uint8_t index = bytes_get_u8(&link->arguments);
    struct row row;

    if (table >= LINK_TABLE_COUNT) {
        return link_refuse_field(link, 0u, 0.0f, (float)(LINK_TABLE_COUNT - 1));
    }
    if (index >= counts[table]) {
        return link_refuse_field(link, 1u, 0.0f, (float)(counts[table] - 1u));
    }
    row = row_of(table, index);
    bytes_put_u8(&link->reply, table);
    bytes_put_u8(&link->reply, index);
    bytes_put_u8(&link->reply, (uint8_t)counts[table]);
    bytes_put_u16(&link->reply, (uint16_t)row.id);
    bytes_put_u8(&link->reply, row.kind);
    bytes_put_u8(&link->reply, row.change);
    bytes_put_f32(&link->reply, row.standard);
    bytes_put_f32(&link->reply, row.low);
    bytes_put_f32(&link->reply, row.high);
    bytes_put_text(&link->reply, row.symbol, LINK_SYMBOL_WIDTH);
    bytes_put_text(&link->reply, row.unit, LINK_UNIT_WIDTH);
    bytes_put_text(&link->reply, row.help, LINK_HELP_WIDTH);
    return link_answer(link);
}

static uint32_t signal_now(struct link *link, enum signal signal)
{
    struct executive_report report;

    executive_report(link->executive, &report);
    return signals_word(signal, &report.now, &executive_plan(link->executive)->scale);
}

enum link_progress link_read(struct link *link)
{
    const uint8_t table = bytes_get_u8(&link->arguments);
    const uint8_t index = bytes_get_u8(&link->arguments);
    const size_t count = table == LINK_NOW ? SIGNAL_COUNT : params_count;

    if (table >= LINK_PLACE_COUNT) {
        return link_refuse_field(link, 0u, 0.0f, (float)(LINK_PLACE_COUNT - 1));
    }
    if (index >= count) {
        return link_refuse_field(link, 1u, 0.0f, (float)(count - 1u));
    }
    bytes_put_u8(&link->reply, table);
    bytes_put_u8(&link->reply, index);
    if (table == LINK_NOW) {
        bytes_put_u32(&link->reply, signal_now(link, (enum signal)index));
    } else {
        bytes_put_f32(&link->reply,
                      params_value(table == LINK_STAGED ? link_staged(link) : executive_params(link->executive),
                                   &params_table[index]));
    }
    return link_answer(link);
}
