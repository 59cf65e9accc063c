# One image: `serve` is everything in one container, docker-compose.yml runs its parts apart.
# The tools that build the page and the wheel stay in the first stage.

FROM python:3.13-slim AS wheel
WORKDIR /source
COPY locks/development.lock ./
RUN pip install --no-cache-dir --require-hashes --only-binary :all: -r development.lock
COPY . ./
RUN python tools/fetch_assets.py \
 && pip wheel --no-cache-dir --no-deps --no-build-isolation --wheel-dir /wheel .

FROM python:3.13-slim AS environment
COPY locks/runtime.lock ./
RUN python -m venv /opt/caesura \
 && /opt/caesura/bin/pip install --no-cache-dir --require-hashes --only-binary :all: -r runtime.lock
COPY --from=wheel /wheel /wheel
RUN /opt/caesura/bin/pip install --no-cache-dir --no-deps /wheel/*.whl

FROM python:3.13-slim
# Compiled kernels fit one kind of processor: they are cached beside the data, never in the image.
ENV PATH=/opt/caesura/bin:$PATH \
    CAESURA_DATA_DIR=/data \
    CAESURA_HOST=0.0.0.0 \
    NUMBA_CACHE_DIR=/data/numba \
    PYTHONDONTWRITEBYTECODE=1 \
    PYTHONUNBUFFERED=1
# By number, so that Kubernetes can see that it is not root.
RUN install -d -o 10001 -g 10001 /data
COPY --from=environment /opt/caesura /opt/caesura
USER 10001:10001
WORKDIR /data
VOLUME /data
EXPOSE 8000
HEALTHCHECK --interval=10s --timeout=5s --start-period=20s --retries=3 \
    CMD ["python", "-c", "from urllib.request import urlopen; urlopen('http://127.0.0.1:8000/healthz', timeout=4)"]
ENTRYPOINT ["caesura"]
CMD ["serve", "--port", "8000"]
