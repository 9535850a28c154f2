# SPDX-License-Identifier: MIT
# The program on Debian 12, from these sources:
#   docker build -t alembert .
#   docker run --rm -v "$PWD:/work" alembert check scenes/textbook/double_pendulum.toml

# What run.sh installs; .devcontainer begins with it.
FROM debian:12 AS tools
ENV LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive
WORKDIR /alembert
RUN apt-get -qq update && apt-get -qq -y --no-install-recommends install ca-certificates git && rm -rf /var/lib/apt/lists/*
COPY .ci/setup.sh .ci/
RUN mkdir build && bash -euc '. .ci/setup.sh && install_missing' && rm -rf /var/lib/apt/lists/*

# The package of Debian, without tests.
FROM tools AS made
COPY . .
RUN ./run.sh scenes/textbook/double_pendulum.toml && cmake --preset release -DALEMBERT_TESTS=OFF && \
    cmake --build build/release --target package

FROM debian:12
ENV LANG=C.UTF-8
RUN --mount=type=bind,from=made,source=/alembert/build/release,target=/made \
    apt-get -qq update && DEBIAN_FRONTEND=noninteractive apt-get -qq -y install /made/alembert_*.deb && rm -rf /var/lib/apt/lists/*
WORKDIR /work
ENTRYPOINT ["alembert"]
CMD ["--help"]
