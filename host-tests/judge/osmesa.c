/* Mesa's rasterizer, as a program of its own: triangles in, covered pixels out.
 *
 * Compiled, fed and compared by `cargo run -p host-tests --release --bin judge`. By hand:
 *
 *     cc -O2 judge/osmesa.c -o osmesa -lOSMesa        (Debian: libosmesa6-dev)
 *     ./osmesa < triangles
 *
 * Input: `WIDTH HEIGHT`, powers of two, then nine integers a triangle, `X Y K` a vertex: X and Y in
 * 1/256 of a pixel from the corner, on the screen, and w = 2^K, 0 to 4.
 * Output: `INDEX Y X0 X1` for each run of covered pixels, X1 not covered; triangles count from 0.
 * The renderer goes to standard error. It is llvmpipe, whose grid is 8 subpixel bits; softpipe's is 4.
 *
 * Y is GL's: row 0 is the lowest. GL leaves open which of the pixels on an edge belong to a
 * triangle; Mesa takes those on a left edge and those on an edge of least y. With the rows counted
 * from the top that is the top-left rule, so the caller passes its own y, down, as GL's y, up.
 *
 * Everything is exact in floats: with sides that are powers of two, clip coordinates are multiples
 * of 2^-17 within [-16, 16], and the division by w and the viewport map are shifts.
 */
#define _POSIX_C_SOURCE 200112L

#include <GL/osmesa.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One vertex from subpixels to clip space. */
static void vertex(int width, int height, const int v[3])
{
    float w = (float)(1 << v[2]);
    float x = (float)(2 * v[0] - 256 * width) / (float)(256 * width);
    float y = (float)(2 * v[1] - 256 * height) / (float)(256 * height);
    glVertex4f(x * w, y * w, 0.0f, w);
}

/* Prints the runs of what was drawn on black. */
static void print_runs(long index, int width, int height, const unsigned char *pixels)
{
    for (int y = 0; y < height; y++) {
        const unsigned char *row = pixels + (size_t)4 * width * y;
        for (int x = 0; x < width;) {
            int x0 = x;
            while (x < width && row[4 * x] != 0)
                x++;
            if (x > x0)
                printf("%ld %d %d %d\n", index, y, x0, x);
            else
                x++;
        }
    }
}

int main(void)
{
    int width, height;
    if (scanf("%d %d", &width, &height) != 2 || width < 1 || height < 1 || width > 4096
        || height > 4096 || (width & (width - 1)) || (height & (height - 1))) {
        fprintf(stderr, "two sides first, powers of two up to 4096\n");
        return 2;
    }
    setenv("GALLIUM_DRIVER", "llvmpipe", 1);
    unsigned char *pixels = malloc((size_t)4 * width * height);
    OSMesaContext context = OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, NULL);
    if (!pixels || !context
        || !OSMesaMakeCurrent(context, pixels, GL_UNSIGNED_BYTE, width, height)) {
        fprintf(stderr, "OSMesa makes no context\n");
        return 2;
    }
    GLint bits = 0;
    glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
    fprintf(stderr, "%s, %s, %d subpixel bits\n", (const char *)glGetString(GL_VERSION),
            (const char *)glGetString(GL_RENDERER), bits);
    if (bits != 8) {
        fprintf(stderr, "8 subpixel bits are needed\n");
        return 2;
    }
    glViewport(0, 0, width, height);
    glClearColor(0, 0, 0, 0);
    glColor3f(1, 1, 1);
    int v[3][3];
    for (long index = 0;; index++) {
        int got = 0;
        for (int i = 0; i < 9; i++)
            got += scanf("%d", &v[i / 3][i % 3]) == 1;
        if (got == 0)
            break;
        if (got != 9) {
            fprintf(stderr, "triangle %ld: %d numbers, not 9\n", index, got);
            return 2;
        }
        glClear(GL_COLOR_BUFFER_BIT);
        glBegin(GL_TRIANGLES);
        for (int i = 0; i < 3; i++)
            vertex(width, height, v[i]);
        glEnd();
        glFinish();
        print_runs(index, width, height, pixels);
    }
    OSMesaDestroyContext(context);
    free(pixels);
    return 0;
}
