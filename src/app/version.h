/* Which firmware this is. */
#ifndef APP_VERSION_H
#define APP_VERSION_H

const char *version_name(void);     /* 0.1.0 */
const char *version_build_id(void); /* the commit, with -dirty behind it where the tree differs; unknown without git */

#endif
