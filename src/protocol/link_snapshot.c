/* A run goes over the line, away from here or back: an image in pieces. */
#include "base/mem.h"
#include "protocol/link_parts.h"

enum { FIELD_OFFSET, FIELD_SIZE }; /* of both */

static enum link_progress refuse_piece(struct link *link, uint32_t expected)
{
    return link_refuse(link,
                       &(struct link_refusal){
                           .error = ERROR_BAD_PIECE, .has_index = true, .index = FIELD_OFFSET, .expected = expected});
}

/* Bytes of the piece at an offset; the last one is shorter, and filled up. */
static size_t piece_size(uint16_t offset)
{
    const size_t left = (size_t)SNAPSHOT_SIZE - offset;

    return left < LINK_PIECE ? left : LINK_PIECE;
}

static bool is_place(uint16_t offset) { return offset % LINK_PIECE == 0u && offset < SNAPSHOT_SIZE; }

/* --- Away --------------------------------------------------------------------------------------------------------- */

static enum link_progress begin_snapshot(struct link *link)
{
    struct executive_report report;
    enum error obstacle;

    executive_report(link->executive, &report);
    obstacle = link_find_obstacle(link, &report);
    if (obstacle != ERROR_OK) {
        return link_refuse_plain(link, obstacle);
    }
    executive_snapshot(link->executive);
    link->image.state = LINK_IMAGE_TAKEN;
    link->phase = 1u;
    return LINK_ADVANCES;
}

enum link_progress link_snapshot(struct link *link)
{
    const uint16_t offset = bytes_get_u16(&link->arguments);
    uint8_t piece[LINK_PIECE] = {0};

    if (!is_place(offset) || (offset != 0u && link->image.state != LINK_IMAGE_TAKEN)) {
        return refuse_piece(link, 0u);
    }
    if (offset == 0u && link->phase == 0u) {
        return begin_snapshot(link);
    }
    memcpy(piece, link->executive->image + offset, piece_size(offset));
    bytes_put_u16(&link->reply, SNAPSHOT_SIZE);
    bytes_put_u16(&link->reply, offset);
    bytes_put_block(&link->reply, piece, sizeof piece);
    return link_answer(link);
}

/* --- Back --------------------------------------------------------------------------------------------------------- */

static enum link_progress answer_restore(struct link *link)
{
    struct executive_report report;

    executive_report(link->executive, &report);
    bytes_put_u16(&link->reply, link->image.next);
    bytes_put_u64(&link->reply, report.now.step);
    return link_answer(link);
}

/* The image is whole: checks it, and orders the run into force. */
static enum link_progress put_in_force(struct link *link)
{
    struct params_problem problem;

    if (!turn_take(link->turn, TURN_LINK)) {
        return link_refuse_plain(link, ERROR_BUSY);
    }
    if (executive_wants_tick(link->executive)) {
        return link_refuse_plain(link, ERROR_IS_RUNNING);
    }
    problem = executive_restore(link->executive);
    if (problem.error != ERROR_OK) {
        return link_refuse_problem(link, &problem);
    }
    link->phase = 1u;
    return LINK_ADVANCES;
}

enum link_progress link_restore(struct link *link)
{
    const uint16_t offset = bytes_get_u16(&link->arguments);
    const uint16_t size = bytes_get_u16(&link->arguments);
    const uint8_t *piece = bytes_get_block(&link->arguments, LINK_PIECE);
    struct link_image *image = &link->image;

    if (link->phase != 0u) {
        return answer_restore(link);
    }
    if (size != SNAPSHOT_SIZE) {
        return link_refuse(
            link, &(struct link_refusal){
                      .error = ERROR_WRONG_LAYOUT, .has_index = true, .index = FIELD_SIZE, .expected = SNAPSHOT_SIZE});
    }
    if (offset == 0u) {
        *image = (struct link_image){.state = LINK_IMAGE_COMING};
    }
    if (image->state != LINK_IMAGE_COMING || !is_place(offset) || offset > image->next) {
        return refuse_piece(link, image->state == LINK_IMAGE_COMING ? image->next : 0u);
    }
    memcpy(link->executive->image + offset, piece, piece_size(offset));
    image->next = (uint16_t)(offset + piece_size(offset));
    return image->next == SNAPSHOT_SIZE ? put_in_force(link) : answer_restore(link);
}
