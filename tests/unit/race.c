/* A program with a data race: two threads add to one number without a lock. The thread sanitizer must end it with an
 * error. */
#include <pthread.h>
#include <stddef.h>

static unsigned sum;

static void *add(void *times)
{
    for (size_t i = 0; i < (size_t)times; i++)
        sum++;
    return NULL;
}

int main(void)
{
    pthread_t threads[2];
    for (int i = 0; i < 2; i++)
        if (pthread_create(&threads[i], NULL, add, (void *)(size_t)1000))
            return 0;
    for (int i = 0; i < 2; i++)
        pthread_join(threads[i], NULL);
    return sum == 0;
}
