//! The functions of preview 2 that end the match. Written by `cargo xtask wasi`, not by hand.

use crate::guest::missing;

#[unsafe(export_name = "wasi:io/error@0.2.12#[method]error.to-debug-string")]
extern "C" fn missing_0(_: i32) -> i32 {
    missing("wasi:io/error#error.to-debug-string")
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.write-zeroes")]
extern "C" fn missing_1(_: i32, _: i64) -> i32 {
    missing("wasi:io/streams#output-stream.write-zeroes")
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.blocking-write-zeroes-and-flush")]
extern "C" fn missing_2(_: i32, _: i64) -> i32 {
    missing("wasi:io/streams#output-stream.blocking-write-zeroes-and-flush")
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.splice")]
extern "C" fn missing_3(_: i32, _: i32, _: i64) -> i32 {
    missing("wasi:io/streams#output-stream.splice")
}

#[unsafe(export_name = "wasi:io/streams@0.2.12#[method]output-stream.blocking-splice")]
extern "C" fn missing_4(_: i32, _: i32, _: i64) -> i32 {
    missing("wasi:io/streams#output-stream.blocking-splice")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.read-via-stream")]
extern "C" fn missing_5(_: i32, _: i64) -> i32 {
    missing("wasi:filesystem/types#descriptor.read-via-stream")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.write-via-stream")]
extern "C" fn missing_6(_: i32, _: i64) -> i32 {
    missing("wasi:filesystem/types#descriptor.write-via-stream")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.append-via-stream")]
extern "C" fn missing_7(_: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.append-via-stream")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.advise")]
extern "C" fn missing_8(_: i32, _: i64, _: i64, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.advise")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.sync-data")]
extern "C" fn missing_9(_: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.sync-data")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.get-flags")]
extern "C" fn missing_10(_: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.get-flags")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.get-type")]
extern "C" fn missing_11(_: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.get-type")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.set-size")]
extern "C" fn missing_12(_: i32, _: i64) -> i32 {
    missing("wasi:filesystem/types#descriptor.set-size")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.set-times")]
extern "C" fn missing_13(_: i32, _: i32, _: i64, _: i32, _: i32, _: i64, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.set-times")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.read")]
extern "C" fn missing_14(_: i32, _: i64, _: i64) -> i32 {
    missing("wasi:filesystem/types#descriptor.read")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.write")]
extern "C" fn missing_15(_: i32, _: i32, _: i32, _: i64) -> i32 {
    missing("wasi:filesystem/types#descriptor.write")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.read-directory")]
extern "C" fn missing_16(_: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.read-directory")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.sync")]
extern "C" fn missing_17(_: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.sync")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.create-directory-at")]
extern "C" fn missing_18(_: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.create-directory-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.stat")]
extern "C" fn missing_19(_: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.stat")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.stat-at")]
extern "C" fn missing_20(_: i32, _: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.stat-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.set-times-at")]
extern "C" fn missing_21(
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i64,
    _: i32,
    _: i32,
    _: i64,
    _: i32,
) -> i32 {
    missing("wasi:filesystem/types#descriptor.set-times-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.link-at")]
extern "C" fn missing_22(_: i32, _: i32, _: i32, _: i32, _: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.link-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.open-at")]
extern "C" fn missing_23(_: i32, _: i32, _: i32, _: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.open-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.readlink-at")]
extern "C" fn missing_24(_: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.readlink-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.remove-directory-at")]
extern "C" fn missing_25(_: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.remove-directory-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.rename-at")]
extern "C" fn missing_26(_: i32, _: i32, _: i32, _: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.rename-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.symlink-at")]
extern "C" fn missing_27(_: i32, _: i32, _: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.symlink-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.unlink-file-at")]
extern "C" fn missing_28(_: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.unlink-file-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.is-same-object")]
extern "C" fn missing_29(_: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.is-same-object")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.metadata-hash")]
extern "C" fn missing_30(_: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.metadata-hash")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]descriptor.metadata-hash-at")]
extern "C" fn missing_31(_: i32, _: i32, _: i32, _: i32) -> i32 {
    missing("wasi:filesystem/types#descriptor.metadata-hash-at")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#[method]directory-entry-stream.read-directory-entry")]
extern "C" fn missing_32(_: i32) -> i32 {
    missing("wasi:filesystem/types#directory-entry-stream.read-directory-entry")
}

#[unsafe(export_name = "wasi:filesystem/types@0.2.12#filesystem-error-code")]
extern "C" fn missing_33(_: i32) -> i32 {
    missing("wasi:filesystem/types#filesystem-error-code")
}

#[unsafe(export_name = "wasi:sockets/instance-network@0.2.12#instance-network")]
extern "C" fn missing_34() -> i32 {
    missing("wasi:sockets/instance-network#instance-network")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.start-bind")]
extern "C" fn missing_35(
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
) -> i32 {
    missing("wasi:sockets/udp#udp-socket.start-bind")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.finish-bind")]
extern "C" fn missing_36(_: i32) -> i32 {
    missing("wasi:sockets/udp#udp-socket.finish-bind")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.stream")]
extern "C" fn missing_37(
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
) -> i32 {
    missing("wasi:sockets/udp#udp-socket.stream")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.local-address")]
extern "C" fn missing_38(_: i32) -> i32 {
    missing("wasi:sockets/udp#udp-socket.local-address")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.remote-address")]
extern "C" fn missing_39(_: i32) -> i32 {
    missing("wasi:sockets/udp#udp-socket.remote-address")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.address-family")]
extern "C" fn missing_40(_: i32) -> i32 {
    missing("wasi:sockets/udp#udp-socket.address-family")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.unicast-hop-limit")]
extern "C" fn missing_41(_: i32) -> i32 {
    missing("wasi:sockets/udp#udp-socket.unicast-hop-limit")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.set-unicast-hop-limit")]
extern "C" fn missing_42(_: i32, _: i32) -> i32 {
    missing("wasi:sockets/udp#udp-socket.set-unicast-hop-limit")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.receive-buffer-size")]
extern "C" fn missing_43(_: i32) -> i32 {
    missing("wasi:sockets/udp#udp-socket.receive-buffer-size")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.set-receive-buffer-size")]
extern "C" fn missing_44(_: i32, _: i64) -> i32 {
    missing("wasi:sockets/udp#udp-socket.set-receive-buffer-size")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.send-buffer-size")]
extern "C" fn missing_45(_: i32) -> i32 {
    missing("wasi:sockets/udp#udp-socket.send-buffer-size")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.set-send-buffer-size")]
extern "C" fn missing_46(_: i32, _: i64) -> i32 {
    missing("wasi:sockets/udp#udp-socket.set-send-buffer-size")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]udp-socket.subscribe")]
extern "C" fn missing_47(_: i32) -> i32 {
    missing("wasi:sockets/udp#udp-socket.subscribe")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]incoming-datagram-stream.receive")]
extern "C" fn missing_48(_: i32, _: i64) -> i32 {
    missing("wasi:sockets/udp#incoming-datagram-stream.receive")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]incoming-datagram-stream.subscribe")]
extern "C" fn missing_49(_: i32) -> i32 {
    missing("wasi:sockets/udp#incoming-datagram-stream.subscribe")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]outgoing-datagram-stream.check-send")]
extern "C" fn missing_50(_: i32) -> i32 {
    missing("wasi:sockets/udp#outgoing-datagram-stream.check-send")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]outgoing-datagram-stream.send")]
extern "C" fn missing_51(_: i32, _: i32, _: i32) -> i32 {
    missing("wasi:sockets/udp#outgoing-datagram-stream.send")
}

#[unsafe(export_name = "wasi:sockets/udp@0.2.12#[method]outgoing-datagram-stream.subscribe")]
extern "C" fn missing_52(_: i32) -> i32 {
    missing("wasi:sockets/udp#outgoing-datagram-stream.subscribe")
}

#[unsafe(export_name = "wasi:sockets/udp-create-socket@0.2.12#create-udp-socket")]
extern "C" fn missing_53(_: i32) -> i32 {
    missing("wasi:sockets/udp-create-socket#create-udp-socket")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.start-bind")]
extern "C" fn missing_54(
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.start-bind")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.finish-bind")]
extern "C" fn missing_55(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.finish-bind")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.start-connect")]
extern "C" fn missing_56(
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
    _: i32,
) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.start-connect")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.finish-connect")]
extern "C" fn missing_57(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.finish-connect")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.start-listen")]
extern "C" fn missing_58(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.start-listen")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.finish-listen")]
extern "C" fn missing_59(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.finish-listen")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.accept")]
extern "C" fn missing_60(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.accept")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.local-address")]
extern "C" fn missing_61(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.local-address")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.remote-address")]
extern "C" fn missing_62(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.remote-address")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.is-listening")]
extern "C" fn missing_63(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.is-listening")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.address-family")]
extern "C" fn missing_64(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.address-family")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.set-listen-backlog-size")]
extern "C" fn missing_65(_: i32, _: i64) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.set-listen-backlog-size")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.keep-alive-enabled")]
extern "C" fn missing_66(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.keep-alive-enabled")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.set-keep-alive-enabled")]
extern "C" fn missing_67(_: i32, _: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.set-keep-alive-enabled")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.keep-alive-idle-time")]
extern "C" fn missing_68(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.keep-alive-idle-time")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.set-keep-alive-idle-time")]
extern "C" fn missing_69(_: i32, _: i64) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.set-keep-alive-idle-time")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.keep-alive-interval")]
extern "C" fn missing_70(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.keep-alive-interval")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.set-keep-alive-interval")]
extern "C" fn missing_71(_: i32, _: i64) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.set-keep-alive-interval")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.keep-alive-count")]
extern "C" fn missing_72(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.keep-alive-count")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.set-keep-alive-count")]
extern "C" fn missing_73(_: i32, _: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.set-keep-alive-count")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.hop-limit")]
extern "C" fn missing_74(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.hop-limit")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.set-hop-limit")]
extern "C" fn missing_75(_: i32, _: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.set-hop-limit")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.receive-buffer-size")]
extern "C" fn missing_76(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.receive-buffer-size")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.set-receive-buffer-size")]
extern "C" fn missing_77(_: i32, _: i64) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.set-receive-buffer-size")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.send-buffer-size")]
extern "C" fn missing_78(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.send-buffer-size")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.set-send-buffer-size")]
extern "C" fn missing_79(_: i32, _: i64) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.set-send-buffer-size")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.subscribe")]
extern "C" fn missing_80(_: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.subscribe")
}

#[unsafe(export_name = "wasi:sockets/tcp@0.2.12#[method]tcp-socket.shutdown")]
extern "C" fn missing_81(_: i32, _: i32) -> i32 {
    missing("wasi:sockets/tcp#tcp-socket.shutdown")
}

#[unsafe(export_name = "wasi:sockets/tcp-create-socket@0.2.12#create-tcp-socket")]
extern "C" fn missing_82(_: i32) -> i32 {
    missing("wasi:sockets/tcp-create-socket#create-tcp-socket")
}

#[unsafe(export_name = "wasi:sockets/ip-name-lookup@0.2.12#[method]resolve-address-stream.resolve-next-address")]
extern "C" fn missing_83(_: i32) -> i32 {
    missing("wasi:sockets/ip-name-lookup#resolve-address-stream.resolve-next-address")
}

#[unsafe(export_name = "wasi:sockets/ip-name-lookup@0.2.12#[method]resolve-address-stream.subscribe")]
extern "C" fn missing_84(_: i32) -> i32 {
    missing("wasi:sockets/ip-name-lookup#resolve-address-stream.subscribe")
}

#[unsafe(export_name = "wasi:sockets/ip-name-lookup@0.2.12#resolve-addresses")]
extern "C" fn missing_85(_: i32, _: i32, _: i32) -> i32 {
    missing("wasi:sockets/ip-name-lookup#resolve-addresses")
}
